// Shooting at the sun, and counting what shadows are off by.
#include "truth/shadow_rays.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <stdexcept>

namespace gll::truth {

namespace {

// Of comparisons averaged over `width` texels, each of them bilinear: 1 in the middle, falling to 0 over a
// texel.
float filterWeight(float offset, int width) {
    return std::clamp(0.5F * (static_cast<float>(width) + 1) - std::abs(offset), 0.0F, 1.0F);
}

} // namespace

std::vector<TrueShadow> trueShadows(const RayScene& scene, const SunTruth& sun,
                                    const measure::ColorImage& positions, const Image& normals) {
    const glm::vec3 across =
        glm::normalize(glm::cross(glm::vec3(0, 1, 0), sun.to_sun)); // as the sun's view lies
    const glm::vec3 up = glm::cross(sun.to_sun, across);
    constexpr int samples = 14; // either way
    // Half a texel farther than the filter reaches, so that where a texel's middle lies does not matter to
    // what is called lit or dark all over.
    const float reach = 0.5F * (static_cast<float>(sun.filter_width) + 2);
    std::vector<TrueShadow> truth(positions.pixels.size());
    const auto& stored = std::get<std::vector<float>>(normals.pixels);
    if (stored.size() != 2 * truth.size())
        throw std::invalid_argument("normals want two floats for each position");
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const glm::vec3 position(positions.pixels[i]);
        if (position == glm::vec3(0)) continue;
        const glm::vec3 normal = directionFromOctahedral({stored[2 * i], stored[2 * i + 1]});
        const float cosine = glm::dot(normal, sun.to_sun);
        if (cosine < 0.01F) continue;
        TrueShadow& pixel = truth[i];
        pixel.counts = true;
        pixel.slope_deg = glm::degrees(std::acos(std::min(cosine, 1.0F)));
        const float blocker = scene.distance(position, sun.to_sun);
        pixel.hard = std::isinf(blocker) ? 1.0F : 0.0F;
        pixel.blocker = std::isinf(blocker) ? 0.0F : blocker;
        float sum = 0;
        float weights = 0;
        int lit = 0;
        for (int y = 0; y < samples; ++y)
            for (int x = 0; x < samples; ++x) {
                const auto offset = [&](int k) {
                    return reach * ((static_cast<float>(k) + 0.5F) * 2.0F / samples - 1.0F); // texels
                };
                const float weight =
                    filterWeight(offset(x), sun.filter_width) * filterWeight(offset(y), sun.filter_width);
                // Along the light to where the surface's plane is.
                const glm::vec3 aside = sun.texel * (offset(x) * across + offset(y) * up);
                const glm::vec3 place = position + aside - sun.to_sun * (glm::dot(aside, normal) / cosine);
                const bool sees_sun = std::isinf(scene.distance(place, sun.to_sun));
                lit += sees_sun ? 1 : 0;
                sum += sees_sun ? weight : 0.0F;
                weights += weight;
            }
        pixel.filtered = sum / weights;
        pixel.all_lit = lit == samples * samples;
        pixel.all_dark = lit == 0;
    }
    return truth;
}

void ShadowErrors::add(const std::vector<TrueShadow>& truth, const SunTruth& sun,
                       const measure::ColorImage& visible, float from_deg, float to_deg) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const TrueShadow& pixel = truth[i];
        if (!pixel.counts || pixel.slope_deg < from_deg || pixel.slope_deg >= to_deg) continue;
        const auto seen = static_cast<float>(visible.pixels[i].r);
        ++count_;
        squares_filtered_ += double(seen - pixel.filtered) * double(seen - pixel.filtered);
        squares_hard_ += double(seen - pixel.hard) * double(seen - pixel.hard);
        if (pixel.all_lit) {
            ++lit_;
            acne_ += seen < 0.99F ? 1 : 0;
        }
        if (pixel.all_dark) {
            ++dark_;
            if (seen <= 0.01F) continue;
            // On a surface this steep, what stands on it begins so far away as the sun sees it.
            const float slope_rad = glm::radians(pixel.slope_deg);
            gaps_.push_back(pixel.blocker * std::sin(slope_rad) * std::cos(slope_rad) / sun.texel);
        }
    }
}

namespace {
double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : 100.0 * double(part) / double(whole);
}
} // namespace

double ShadowErrors::acnePercent() const { return percent(acne_, lit_); }
double ShadowErrors::leakPercent() const { return percent(gaps_.size(), dark_); }
double ShadowErrors::gapTexels() const {
    if (gaps_.empty()) return 0;
    std::vector<float> sorted = gaps_;
    std::sort(sorted.begin(), sorted.end());
    return double(sorted[(sorted.size() - 1) * 99 / 100]);
}
double ShadowErrors::rmseToFilter() const {
    return count_ == 0 ? 0 : std::sqrt(squares_filtered_ / double(count_));
}
double ShadowErrors::rmseToHard() const {
    return count_ == 0 ? 0 : std::sqrt(squares_hard_ / double(count_));
}

} // namespace gll::truth
