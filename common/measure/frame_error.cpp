// frame_error: says how far one frame is from another, for people and as JSON for charts and tests.
// Usage: frame_error NEW REFERENCE [--json] [--map FILE.png] [--pixels-per-degree N]
#include "io/image.hpp"
#include "measure/errors.hpp"
#include "measure/flip.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <unistd.h>

namespace gll::measure {
namespace {

// All of it is held in double, some 200 bytes a pixel; an 8K frame has 33.2 million.
constexpr std::size_t max_compared_pixels = std::size_t(1) << 25;

struct Options {
    std::string image;
    std::string reference;
    std::string map;
    double pixels_per_degree = default_pixels_per_degree;
    bool json = false;
};

Image readImage(const std::string& path) {
    Image image = loadImage(path);
    if (static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) > max_compared_pixels)
        throw std::runtime_error(path + ": " + std::to_string(image.width) + "x" +
                                 std::to_string(image.height) + " pixels are more than " +
                                 std::to_string(max_compared_pixels) + ", compare parts of it");
    requireFinite(image, path);
    return image;
}

bool isHdr(const Image& image) { return image.color_space == ColorSpace::linear; }

void requireSameKind(const Options& options, const Image& image, const Image& reference) {
    const auto size = [](const Image& one) {
        return std::to_string(one.width) + "x" + std::to_string(one.height);
    };
    if (image.width != reference.width || image.height != reference.height)
        throw std::runtime_error(options.image + ": is " + size(image) + ", " + options.reference + " is " +
                                 size(reference) + ", give two frames of one size");
    const auto kind = [](const Image& one) { return isHdr(one) ? "linear light" : "display values"; };
    if (isHdr(image) != isHdr(reference))
        throw std::runtime_error(options.image + ": holds " + kind(image) + ", " + options.reference +
                                 " holds " + kind(reference) + ", give two .png or two .exr or .hdr files");
}

double alphaRmse(const ScalarImage& image, const ScalarImage& reference) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double difference = image.pixels[i] - reference.pixels[i];
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(image.pixels.size()));
}

void showProgress(int exposure, int count) {
    std::fprintf(stderr, "\rframe_error: HDR-FLIP, exposure %d of %d", exposure + 1, count);
}

nlohmann::ordered_json measure(const Options& options) {
    const Image image = readImage(options.image);
    const Image reference = readImage(options.reference);
    requireSameKind(options, image, reference);
    const bool hdr = isHdr(image);
    const ColorImage linear = linearColor(image);
    const ColorImage linear_reference = linearColor(reference);

    nlohmann::ordered_json result;
    result["kind"] = hdr ? "hdr" : "ldr";
    result["width"] = image.width;
    result["height"] = image.height;
    if (hdr) {
        result["rmse"] = rmse(linear, linear_reference);
    } else {
        const double display_rmse = rmse(displayColor(image), displayColor(reference));
        result["rmse"] = display_rmse;
        result["psnr_db"] = psnrDb(display_rmse);
    }
    result["relative_rmse"] = relativeRmse(linear, linear_reference);
    result["log2_rmse_ev"] = log2RmseEv(linear, linear_reference);
    result["energy_ratio"] = energyRatio(linear, linear_reference);
    result["alpha_rmse"] = alphaRmse(alpha(image), alpha(reference));

    result["pixels_per_degree"] = options.pixels_per_degree;
    const ScalarImage map = flip(linear, linear_reference, options.pixels_per_degree);
    const FlipSummary ldr_summary = summary(map);
    result["flip_mean"] = ldr_summary.mean;
    result["flip_weighted_median"] = ldr_summary.weighted_median;
    result["flip_max"] = ldr_summary.largest;
    const bool watched = isatty(STDERR_FILENO) == 1;
    const HdrFlip hdr_flip = hdrFlip(linear, linear_reference, options.pixels_per_degree,
                                     watched ? showProgress : std::function<void(int, int)>());
    if (watched) std::fputs("\r\033[K", stderr);
    const FlipSummary hdr_summary = summary(hdr_flip.map);
    result["hdr_flip_mean"] = hdr_summary.mean;
    result["hdr_flip_weighted_median"] = hdr_summary.weighted_median;
    result["hdr_flip_max"] = hdr_summary.largest;
    result["hdr_flip_start_ev"] = hdr_flip.exposures.start_ev;
    result["hdr_flip_stop_ev"] = hdr_flip.exposures.stop_ev;
    result["hdr_flip_exposures"] = hdr_flip.exposures.count;

    if (!options.map.empty()) saveImage(options.map, heatMap(hdr ? hdr_flip.map : map));
    return result;
}

void print(const nlohmann::ordered_json& result) {
    for (const auto& [name, value] : result.items()) {
        if (value.is_number_float() && !std::isfinite(value.get<double>()))
            std::printf("%-25s infinite\n", name.c_str());
        else if (value.is_number_float())
            std::printf("%-25s %.6g\n", name.c_str(), value.get<double>());
        else
            std::printf("%-25s %s\n", name.c_str(),
                        value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
    }
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app(
        "Says how far the frame NEW is from the frame REFERENCE: two PNG or JPEG files (display values) "
        "or two EXR or HDR files (linear light), of one size.\n"
        "rmse and psnr_db are of display values, rmse of an HDR pair of linear light; relative_rmse, "
        "log2_rmse_ev, energy_ratio and hdr_flip_* of linear light; flip_* of what a display shows, that "
        "is linear light clamped to [0, 1]. null in JSON stands for infinite.\n"
        "Ends with 0 when measured, 1 when that is not possible, 2 on wrong usage.",
        "frame_error");
    app.add_option("NEW", options.image, "The frame to judge")->required();
    app.add_option("REFERENCE", options.reference, "The frame that is right")->required();
    app.add_flag("--json", options.json, "Print one JSON object");
    app.add_option("--map", options.map, "Write the map of FLIP (of HDR-FLIP for an HDR pair) as a picture")
        ->type_name("FILE.png")
        ->check([](const std::string& path) {
            return path.ends_with(".png") ? std::string() : "'" + path + "' is no .png file";
        });
    app.add_option("--pixels-per-degree", options.pixels_per_degree, "Viewing distance that FLIP assumes")
        ->capture_default_str()
        ->check([](const std::string& text) { // CLI::Range lets nan pass
            double value = 0;
            const bool number = CLI::detail::lexical_cast(text, value);
            return number && value >= least_pixels_per_degree && value <= most_pixels_per_degree
                       ? std::string()
                       : "'" + text + "' is no number from 1 to 1000";
        });
    app.set_version_flag("--version", "frame_error " GLLADDER_VERSION " (GL Ladder)");
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        std::fprintf(stderr, "frame_error: error: %s, see --help\n", error.what());
        return 2;
    }
    for (const std::string& frame : {options.image, options.reference}) {
        std::error_code ignored; // of a map that is not there yet
        if (!options.map.empty() && std::filesystem::equivalent(options.map, frame, ignored)) {
            std::fprintf(stderr,
                         "frame_error: error: --map %s: is one of the frames and would be overwritten, "
                         "name another file\n",
                         options.map.c_str());
            return 2;
        }
    }
    try {
        const nlohmann::ordered_json result = measure(options);
        if (options.json)
            std::puts(result.dump().c_str());
        else
            print(result);
        if (std::fflush(stdout) != 0) throw std::runtime_error("stdout: cannot be written, make room there");
        return 0;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "frame_error: error: %s: needs more memory than there is, compare parts of it\n",
                     options.image.c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "frame_error: error: %s\n", error.what());
    }
    return 1;
}

} // namespace
} // namespace gll::measure

int main(int argc, char** argv) { return gll::measure::run(argc, argv); }
