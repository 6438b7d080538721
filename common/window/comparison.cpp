// Measuring and showing how two pictures differ.
#include "window/comparison.hpp"

#include "measure/errors.hpp"
#include "measure/flip.hpp"

#include <cmath>
#include <utility>

namespace gll {
namespace {

int pixelsThatDiffer(const Image& a, const Image& b) {
    const auto& one = std::get<std::vector<std::uint8_t>>(a.pixels);
    const auto& other = std::get<std::vector<std::uint8_t>>(b.pixels);
    const auto channels = static_cast<std::size_t>(a.channels);
    int count = 0;
    for (std::size_t i = 0; i < one.size(); i += channels) {
        bool differs = false;
        for (std::size_t c = 0; c < channels; ++c)
            differs = differs || one[i + c] != other[i + c];
        count += differs ? 1 : 0;
    }
    return count;
}

Difference differenceOf(const Image& a, const Image& b, int frame) {
    Difference difference{.frame = frame, .of = a.width * a.height};
    difference.pixels = pixelsThatDiffer(a, b);
    difference.rmse = measure::rmse(measure::displayColor(b), measure::displayColor(a));
    const measure::ScalarImage map = measure::flip(measure::linearColor(b), measure::linearColor(a));
    difference.flip = measure::summary(map).mean;
    difference.map = measure::heatMap(map);
    return difference;
}

} // namespace

void Comparison::measure(const Renderer& a, const Renderer& b, int frame, const History::State& key,
                         double now_s) {
    constexpr double rest_s = 1;
    if (running_.valid()) {
        if (running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
        measured_ = running_.get();
        is_uploaded_ = false;
        next_s_ = now_s + rest_s;
    }
    if (now_s < next_s_ || (key == measured_key_ && measured_)) return;
    measured_key_ = key;
    running_ = std::async(std::launch::async, [image_a = a.image(), image_b = b.image(), frame] {
        return differenceOf(image_a, image_b, frame);
    });
}

bool Comparison::showsB(double now_s) {
    constexpr double each_s = 0.6;
    return std::fmod(now_s, 2 * each_s) >= each_s;
}

const Framebuffer* Comparison::picture(Renderer& a, const Renderer& b) {
    const glm::ivec2 size = a.presented().size();
    if (mode == Mode::difference && b.presented().size() == size) {
        shown_.resize(size);
        drawPass("difference", shown_,
                 {.program = a.shaders().fullScreen("window/difference.frag"),
                  .inputs = {{"one", a.presented().color()}, {"other", b.presented().color()}},
                  .uniforms = {{"factor", difference_factor}}},
                 a.fullScreenTriangle());
        is_uploaded_ = false;
        return &shown_;
    }
    if (mode != Mode::flip || !measured_ || glm::ivec2(measured_->map.width, measured_->map.height) != size)
        return nullptr;
    shown_.resize(size);
    if (!is_uploaded_) {
        // Rows from the bottom, as OpenGL has them.
        const auto& from = std::get<std::vector<std::uint8_t>>(measured_->map.pixels);
        const std::size_t row = static_cast<std::size_t>(size.x) * 3;
        std::vector<std::uint8_t> flipped;
        for (int y = size.y - 1; y >= 0; --y) {
            const auto begin = from.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row);
            flipped.insert(flipped.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
        }
        glBindTexture(GL_TEXTURE_2D, shown_.color().id());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, flipped.data());
        glBindTexture(GL_TEXTURE_2D, 0);
        is_uploaded_ = true;
    }
    return &shown_;
}

} // namespace gll
