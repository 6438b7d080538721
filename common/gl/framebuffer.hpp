// A render target: named colour attachments and at most one depth attachment, all textures, all of one size.
#pragma once

#include "gl/texture.hpp"

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gll {

// Colour attachments take locations 0, 1, ... in their order; one of a depth format becomes the depth
// attachment. The name is what --target and the window's inspector show it under.
struct Attachment {
    std::string name;
    Format format = Format::rgba16f;
    Filter filter = Filter::linear;
    Wrap wrap = Wrap::clamp_to_edge;
    bool compare_depth = false;
    bool mipmapped =
        false; // with all levels down to 1x1, which Pass::generate_mipmaps fills; drawn to is level 0

    bool operator==(const Attachment&) const = default;
};

class Framebuffer {
  public:
    // Without attachments, nothing can be drawn to it until remake() gives it some.
    Framebuffer() = default;
    // Throws std::runtime_error naming the attachments where the framebuffer is not complete.
    Framebuffer(std::vector<Attachment> attachments, glm::ivec2 size);

    // Where the attachments or the size differ from what it has, it is made anew and its contents are
    // undefined; else nothing happens. Where that throws (see the constructor, and Texture's for sizes), the
    // framebuffer is as it was.
    void remake(std::vector<Attachment> attachments, glm::ivec2 size);
    void resize(glm::ivec2 size) { remake(attachments_, size); }

    glm::ivec2 size() const { return size_; }
    GLuint id() const { return handle_.id(); }
    int colorCount() const { return color_count_; }
    bool hasDepth() const { return color_count_ < static_cast<int>(textures_.size()); }

    // Throws std::out_of_range where there is no such attachment.
    const Texture& color(int location = 0) const;
    const Texture& depth() const;
    const Texture& operator[](std::string_view name) const;

    // The attachments with their names: colours in order of location, then depth.
    const std::vector<Attachment>& attachments() const { return attachments_; }
    const Texture& texture(std::size_t index) const { return textures_.at(index); }

  private:
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
    void create();
    std::runtime_error incomplete(const std::string& why) const;

    std::vector<Attachment> attachments_;
    std::vector<Texture> textures_; // one for each attachment, in the same order
    glm::ivec2 size_{0};
    int color_count_ = 0;
    Handle<destroy> handle_;
};

} // namespace gll
