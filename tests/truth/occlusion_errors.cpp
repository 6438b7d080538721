// Sorting a frame's errors by what is true there.
#include "truth/occlusion_errors.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gll::truth {
namespace {

bool isInPlane(const SeenPoint& point, const SeenPoint& other) {
    constexpr float near = 0.01F;     // world units
    constexpr float aligned = 0.996F; // within five degrees
    return other.is_surface && glm::dot(point.normal, other.normal) > aligned &&
           std::abs(glm::dot(point.normal, other.position - point.position)) < near;
}

} // namespace

double PixelErrors::rmse() const { return count_ == 0 ? 0 : std::sqrt(squares_ / double(count_)); }
double PixelErrors::bias() const { return count_ == 0 ? 0 : sum_ / double(count_); }

void addErrors(OcclusionErrors& errors, const TrueOcclusion& truth, const measure::ColorImage& visible) {
    constexpr int border = 8;
    constexpr float open = 0.995F;
    const int height = static_cast<int>(truth.points.size()) / truth.width;
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * truth.width + x); };
    const auto isFlat = [&](std::size_t i) {
        return truth.points[i].is_surface && truth.visibility[i] >= open;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            const std::size_t i = at(x, y);
            if (!truth.points[i].is_surface) continue;
            const double seen = visible.pixels[i].r;
            const double error = seen - double(truth.visibility[i]);
            errors.all.add(error);
            errors.on_screen.add(seen - double(truth.on_screen[i]));
            (isFlat(i) ? errors.flat : errors.creased).add(error);
            if (truth.visibility[i] < 0.5F) errors.dark.add(error);
            if (truth.on_screen[i] < truth.visibility[i] - 0.1F) errors.halo.add(error);
            if (std::min({x, y, truth.width - 1 - x, height - 1 - y}) < border) errors.border.add(error);
            if (x < 2 || y < 2 || x >= truth.width - 2 || y >= height - 2) continue;
            double mean = 0;
            bool is_one_plane = true;
            for (int dy = -2; dy <= 2; ++dy)
                for (int dx = -2; dx <= 2; ++dx) {
                    const std::size_t j = at(x + dx, y + dy);
                    is_one_plane = is_one_plane && isInPlane(truth.points[i], truth.points[j]);
                    mean += visible.pixels[j].r / 25;
                }
            if (is_one_plane) errors.noise.add(seen - mean);
        }
}

} // namespace gll::truth
