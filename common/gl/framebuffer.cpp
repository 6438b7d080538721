// Framebuffer creation, resizing and lookup.
#include "gl/framebuffer.hpp"

#include <algorithm>
#include <stdexcept>

namespace gll {
namespace {

bool isDepth(const Attachment& attachment) { return formatInfo(attachment.format).is_depth; }

const char* statusName(GLenum status) {
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "incomplete attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER:
        return "incomplete draw buffer";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "this combination of formats is not supported";
    default:
        return "not complete";
    }
}

// Colours in their order, then depth.
void arrange(std::vector<Attachment>& attachments) {
    std::stable_partition(attachments.begin(), attachments.end(),
                          [](const Attachment& a) { return !isDepth(a); });
}

} // namespace

Framebuffer::Framebuffer(std::vector<Attachment> attachments, glm::ivec2 size)
    : attachments_(std::move(attachments)), size_(size) {
    arrange(attachments_);
    color_count_ = static_cast<int>(std::count_if(attachments_.begin(), attachments_.end(),
                                                  [](const Attachment& a) { return !isDepth(a); }));
    GLint most_colors = 0;
    glGetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &most_colors);
    if (color_count_ > most_colors)
        throw incomplete("more than " + std::to_string(most_colors) + " colour attachments");
    if (std::ssize(attachments_) > color_count_ + 1) throw incomplete("more than one depth attachment");
    create();
}

void Framebuffer::remake(std::vector<Attachment> attachments, glm::ivec2 size) {
    arrange(attachments);
    if (attachments != attachments_ || size != size_) *this = Framebuffer(std::move(attachments), size);
}

void Framebuffer::create() {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    handle_ = Handle<destroy>(id);
    textures_.clear();
    glBindFramebuffer(GL_FRAMEBUFFER, id);
    std::vector<GLenum> draw_buffers;
    for (const Attachment& attachment : attachments_) {
        textures_.emplace_back(TextureDescription{.size = size_,
                                                  .format = attachment.format,
                                                  .filter = attachment.filter,
                                                  .wrap_x = attachment.wrap,
                                                  .wrap_y = attachment.wrap,
                                                  .levels = attachment.mipmapped ? levelCount(size_) : 1,
                                                  .compare_depth = attachment.compare_depth});
        GLenum point = GL_DEPTH_ATTACHMENT;
        if (!isDepth(attachment)) {
            point = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + draw_buffers.size());
            draw_buffers.push_back(point);
        }
        glFramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, textures_.back().id(), 0);
    }
    if (draw_buffers.empty()) {
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    } else {
        glDrawBuffers(static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    }
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (status != GL_FRAMEBUFFER_COMPLETE) throw incomplete(statusName(status));
}

std::runtime_error Framebuffer::incomplete(const std::string& why) const {
    std::string message = "framebuffer (";
    for (const Attachment& attachment : attachments_)
        message += attachment.name + " " + formatInfo(attachment.format).name + ", ";
    return std::runtime_error(message + std::to_string(size_.x) + "x" + std::to_string(size_.y) +
                              "): " + why);
}

const Texture& Framebuffer::color(int location) const {
    if (location < 0 || location >= color_count_)
        throw std::out_of_range("framebuffer: no colour attachment " + std::to_string(location));
    return textures_[static_cast<std::size_t>(location)];
}

const Texture& Framebuffer::depth() const {
    if (!hasDepth()) throw std::out_of_range("framebuffer: no depth attachment");
    return textures_.back();
}

const Texture& Framebuffer::operator[](std::string_view name) const {
    for (std::size_t i = 0; i < attachments_.size(); ++i)
        if (attachments_[i].name == name) return textures_[i];
    throw std::out_of_range("framebuffer: no attachment named " + std::string(name));
}

} // namespace gll
