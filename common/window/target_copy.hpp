// A copy of one level of a pass's target, taken right after the pass: later passes may draw over the target,
// and looking around in the copy draws no frame anew.
#pragma once

#include "gl/framebuffer.hpp"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

namespace gll {

// One texel, counted from the lower left: its values, and the bits they are stored as.
struct Texel {
    std::array<float, 4> value{0, 0, 0, 1};
    int channels = 0;
    std::string bits; // in hexadecimal, a word a channel, or one for formats that pack them

    bool operator==(const Texel&) const = default;
};

// Of level 0. Waits for what is being drawn. Throws std::out_of_range where there is no such texel.
Texel readTexel(const Texture& texture, glm::ivec2 place);

class TargetCopy {
  public:
    // level is below levelCount() of a mipmapped texture, else 0. Framebuffers that are bound stay so.
    void take(const Texture& texture, int level);

    bool isTaken() const { return copy_.size().x > 0; }
    const Texture& texture() const { return copy_.texture(0); }
    glm::ivec2 size() const { return copy_.size(); }
    FormatInfo format() const { return formatInfo(copy_.attachments().front().format); }

    // What it holds: texels with something that is no number, and with something infinite, in any channel; of
    // a depth, the least and the greatest below 1, where nothing was drawn.
    struct Contents {
        int no_number = 0;
        int infinite = 0;
        float nearest = 0;
        float farthest = 0.5F;
    };
    Contents contents() const;

  private:
    Framebuffer copy_;
};

// What a person reads of a texel: values, and for colours stops from middle grey and the code of a display.
// is_display: the values are encoded already, [0, 1].
std::string describe(const Texel& texel, bool is_light, bool is_display);

} // namespace gll
