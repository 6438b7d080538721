// Mesh buffers and drawing.
#include "gl/mesh.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>

namespace gll {
namespace {

GLuint fillBuffer(GLenum target, std::span<const std::byte> bytes) {
    GLuint id = 0;
    glGenBuffers(1, &id);
    glBindBuffer(target, id);
    glBufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    return id;
}

void describe(std::span<const VertexAttribute> attributes, int stride_bytes, GLuint divisor) {
    for (const VertexAttribute& attribute : attributes) {
        glEnableVertexAttribArray(attribute.location);
        glVertexAttribPointer(attribute.location, attribute.components, GL_FLOAT, GL_FALSE, stride_bytes,
                              reinterpret_cast<const void*>(attribute.offset_bytes));
        glVertexAttribDivisor(attribute.location, divisor);
    }
}

GLuint makeVertexArray() {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    glBindVertexArray(id);
    return id;
}

} // namespace

Mesh::Mesh(const MeshDescription& description) {
    if (description.vertices.empty() || description.vertex_stride_bytes <= 0)
        throw std::invalid_argument("mesh: no vertices");
    const std::size_t vertex_count =
        description.vertices.size() / static_cast<std::size_t>(description.vertex_stride_bytes);
    for (const std::uint32_t index : description.indices) // drawing what lies beyond is undefined
        if (index >= vertex_count)
            throw std::invalid_argument("mesh: index " + std::to_string(index) + " of " +
                                        std::to_string(vertex_count) + " vertices");
    vertex_array_ = Handle<destroyVertexArray>(makeVertexArray());
    vertices_ = Buffer(fillBuffer(GL_ARRAY_BUFFER, description.vertices));
    describe(description.attributes, description.vertex_stride_bytes, 0);
    if (!description.instances.empty()) {
        instances_ = Buffer(fillBuffer(GL_ARRAY_BUFFER, description.instances));
        describe(description.instance_attributes, description.instance_stride_bytes, 1);
        instanced_ = true;
    }
    if (description.indices.empty()) {
        count_ = static_cast<std::uint32_t>(vertex_count);
    } else {
        indices_ = Buffer(fillBuffer(GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(description.indices)));
        count_ = static_cast<std::uint32_t>(description.indices.size());
        indexed_ = true;
    }
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

Mesh Mesh::fullScreenTriangle() {
    Mesh mesh;
    mesh.vertex_array_ = Handle<destroyVertexArray>(makeVertexArray());
    mesh.count_ = 3;
    glBindVertexArray(0);
    return mesh;
}

void Mesh::draw(int instances, std::uint32_t first_index, std::uint32_t index_count) const {
    if (first_index > count_ || index_count > count_ - first_index)
        throw std::out_of_range("mesh: the part to draw lies outside the mesh");
    const auto count = static_cast<GLsizei>(index_count == 0 ? count_ - first_index : index_count);
    glBindVertexArray(vertex_array_.id());
    if (indexed_) {
        const auto* start = reinterpret_cast<const void*>(std::size_t(first_index) * sizeof(std::uint32_t));
        if (instanced_)
            glDrawElementsInstanced(GL_TRIANGLES, count, GL_UNSIGNED_INT, start, instances);
        else
            glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, start);
    } else {
        glDrawArraysInstanced(GL_TRIANGLES, static_cast<GLint>(first_index), count, instances);
    }
    glBindVertexArray(0);
}

} // namespace gll
