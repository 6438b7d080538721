// FLIP of two images in bands, in parallel, and only where a difference can reach: what a check of many
// frames, or of large ones, has the time and the memory for.
#include "measure/flip.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

namespace gll::measure {
namespace {

constexpr int band_rows = 128;
constexpr std::size_t pixels_worth_a_thread = std::size_t(1) << 18;
// Of a band, for each pixel: two pictures of three doubles, twice, and the map. 60 MB of 3840 columns.
constexpr std::size_t band_pixel_bytes = (2 * 2 * 3 + 1) * sizeof(double);
constexpr std::size_t most_bytes = std::size_t(512) << 20; // of all bands under way, as long as one has room

// Columns from first to last, or none.
struct Extent {
    int first = 0;
    int last = -1;

    bool empty() const { return last < first; }
    void add(const Extent& other) {
        if (other.empty()) return;
        *this = empty() ? other : Extent{std::min(first, other.first), std::max(last, other.last)};
    }
    Extent grown(int by, int size) const { return {std::max(first - by, 0), std::min(last + by, size - 1)}; }
};

// In which columns each row of the two differs.
std::vector<Extent> differingExtents(const Image& one, const Image& other) {
    std::vector<Extent> rows(static_cast<std::size_t>(one.height));
    std::visit(
        [&](const auto& samples) {
            const auto& others = std::get<std::decay_t<decltype(samples)>>(other.pixels);
            const auto channels = static_cast<std::size_t>(one.channels);
            const std::size_t pixel_bytes = channels * sizeof samples[0];
            const auto width = static_cast<std::size_t>(one.width);
            for (std::size_t y = 0; y < rows.size(); ++y) {
                const auto* row = samples.data() + y * width * channels;
                const auto* other_row = others.data() + y * width * channels;
                if (std::memcmp(row, other_row, width * pixel_bytes) == 0) continue;
                const auto differs = [&](std::size_t x) {
                    return std::memcmp(row + x * channels, other_row + x * channels, pixel_bytes) != 0;
                };
                std::size_t first = 0;
                std::size_t last = width - 1;
                while (!differs(first))
                    ++first;
                while (!differs(last))
                    --last;
                rows[y] = {static_cast<int>(first), static_cast<int>(last)};
            }
        },
        one.pixels);
    return rows;
}

Image cropped(const Image& image, const Extent& columns, const Extent& rows) {
    Image result = {.width = columns.last - columns.first + 1,
                    .height = rows.last - rows.first + 1,
                    .channels = image.channels,
                    .color_space = image.color_space,
                    .pixels = {}};
    std::visit(
        [&](const auto& samples) {
            std::decay_t<decltype(samples)> part;
            const auto channels = static_cast<std::ptrdiff_t>(image.channels);
            for (int y = rows.first; y <= rows.last; ++y) {
                const auto begin =
                    samples.begin() + (std::ptrdiff_t(y) * image.width + columns.first) * channels;
                part.insert(part.end(), begin, begin + result.width * channels);
            }
            result.pixels = std::move(part);
        },
        image.pixels);
    return result;
}

// One band of the map: its rows, and the columns that a difference reaches.
class Bands {
  public:
    Bands(const Image& image, const Image& reference, double pixels_per_degree, ScalarImage& map)
        : image_(image), reference_(reference), pixels_per_degree_(pixels_per_degree),
          reach_(flipReachPx(pixels_per_degree)), differing_(differingExtents(image, reference)), map_(map) {
        if (image.color_space != ColorSpace::srgb) exposures_ = flipExposures(linearColor(reference));
    }

    void run() {
        const int count = (map_.height + band_rows - 1) / band_rows;
        const std::size_t worth = std::max<std::size_t>(map_.pixels.size() / pixels_worth_a_thread, 1);
        const std::size_t threads =
            std::min({worth, std::max<std::size_t>(std::thread::hardware_concurrency(), 1),
                      std::max<std::size_t>(most_bytes / bandBytes(), 1)});
        const auto work = [&] {
            try {
                for (int band = next_++; band < count; band = next_++)
                    compute({band * band_rows, std::min((band + 1) * band_rows, map_.height) - 1});
            } catch (...) {
                const std::lock_guard lock(mutex_);
                error_ = std::current_exception();
            }
        };
        std::vector<std::thread> helpers;
        for (std::size_t i = 1; i < threads; ++i)
            helpers.emplace_back(work);
        work();
        for (std::thread& helper : helpers)
            helper.join();
        if (error_) std::rethrow_exception(error_);
    }

  private:
    std::size_t bandBytes() const {
        return static_cast<std::size_t>(map_.width) * static_cast<std::size_t>(band_rows + 2 * reach_) *
               band_pixel_bytes;
    }

    void compute(const Extent& rows) {
        const Extent seen_rows = rows.grown(reach_, map_.height);
        Extent differing;
        for (int y = seen_rows.first; y <= seen_rows.last; ++y)
            differing.add(differing_[static_cast<std::size_t>(y)]);
        if (differing.empty()) return; // FLIP of what is the same is 0
        const Extent columns = differing.grown(reach_, map_.width);
        const Extent seen_columns = columns.grown(reach_, map_.width);
        const ColorImage one = linearColor(cropped(image_, seen_columns, seen_rows));
        const ColorImage other = linearColor(cropped(reference_, seen_columns, seen_rows));
        const Rows wanted{rows.first - seen_rows.first, rows.last - seen_rows.first};
        const ScalarImage part = exposures_ ? hdrFlip(one, other, *exposures_, pixels_per_degree_, wanted)
                                            : flip(one, other, pixels_per_degree_, wanted);
        for (int y = rows.first; y <= rows.last; ++y)
            for (int x = columns.first; x <= columns.last; ++x)
                map_.at(x, y) = part.at(x - seen_columns.first, y - seen_rows.first);
    }

    const Image& image_;
    const Image& reference_;
    double pixels_per_degree_;
    int reach_;
    std::vector<Extent> differing_;
    std::optional<Exposures> exposures_;
    ScalarImage& map_;
    std::atomic<int> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr error_;
};

} // namespace

ScalarImage flipMap(const Image& image, const Image& reference, double pixels_per_degree) {
    if (image.width != reference.width || image.height != reference.height ||
        image.channels != reference.channels || image.color_space != reference.color_space ||
        image.pixels.index() != reference.pixels.index())
        throw std::invalid_argument("flipMap: the images are of two kinds, compare them first");
    ScalarImage map(image.width, image.height);
    Bands(image, reference, pixels_per_degree, map).run();
    return map;
}

} // namespace gll::measure
