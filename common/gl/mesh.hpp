// Vertex, index and instance buffers, and the one draw call they serve.
#pragma once

#include "gl/handle.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gll {

// One float attribute of a vertex (or instance): layout(location = ...) in the shader, 1 to 4 floats,
// starting at byte offset offset_bytes of each element.
struct VertexAttribute {
    GLuint location = 0;
    int components = 3;
    std::size_t offset_bytes = 0;
};

struct MeshDescription {
    std::span<const std::byte> vertices = {};
    int vertex_stride_bytes = 0;
    std::vector<VertexAttribute> attributes = {};
    std::span<const std::uint32_t> indices = {}; // triangles; empty: the vertices in their order
    std::span<const std::byte> instances = {};
    int instance_stride_bytes = 0;
    std::vector<VertexAttribute> instance_attributes = {};
};

class Mesh {
  public:
    // Throws std::invalid_argument where there is no vertex, or an index beyond them.
    explicit Mesh(const MeshDescription& description);

    // Three vertices and no attributes: lib/fullscreen.vert makes the screen-covering triangle from
    // gl_VertexID.
    static Mesh fullScreenTriangle();

    // Draws with whatever program and state are bound; first_index and index_count choose a part (count 0: to
    // the end).
    void draw(int instances = 1, std::uint32_t first_index = 0, std::uint32_t index_count = 0) const;

  private:
    Mesh() = default;
    static void destroyBuffer(GLuint id) { glDeleteBuffers(1, &id); }
    static void destroyVertexArray(GLuint id) { glDeleteVertexArrays(1, &id); }
    using Buffer = Handle<destroyBuffer>;

    Handle<destroyVertexArray> vertex_array_;
    Buffer vertices_;
    Buffer indices_;
    Buffer instances_;
    std::uint32_t count_ = 0; // of indices, or of vertices where there are none
    bool indexed_ = false;
    bool instanced_ = false;
};

} // namespace gll
