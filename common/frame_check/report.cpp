// Filling the page: descriptions as JSON, pictures as base64 beside them, decoded only when they are looked
// at.
#include "frame_check/report.hpp"

#include "frame_check/report_page.hpp"
#include "frame_check/say.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace gll::frame_check {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Bytes = std::vector<std::uint8_t>;

std::string base64(const std::string& bytes) {
    static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? letters[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// IEEE 754 binary16 of a float, rounded to the nearest, ties to even; infinite beyond its range.
std::uint16_t halfOf(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000U);
    const float size = std::abs(value);
    if (std::isnan(value)) return sign | 0x7e00U;
    if (size >= 65520.0F) return sign | 0x7c00U;
    // Below the smallest normal number steps are even.
    if (size < 0x1p-14F) return sign | static_cast<std::uint16_t>(std::nearbyint(size * 0x1p24F));
    const std::uint32_t rounded = (bits & 0x7fffffffU) + 0xfffU + (bits >> 13 & 1U);
    return static_cast<std::uint16_t>(sign | ((rounded >> 13) - (112U << 10)));
}

class Writer {
  public:
    explicit Writer(const fs::path& file) : file_(file), stream_(file, std::ios::binary) {}

    void text(const std::string& text) { stream_ << text; }

    // A frame as the page wants it, or null where it cannot be read.
    Json frame(const fs::path& file) {
        if (file.empty() || !fs::exists(file)) return nullptr;
        Image image;
        try {
            image = loadImage(file);
        } catch (const std::exception&) { // said where it was compared
            return nullptr;
        }
        const bool has_alpha = image.channels == 2 || image.channels == 4;
        const auto* bytes = std::get_if<Bytes>(&image.pixels);
        if (bytes != nullptr && !has_alpha && (file.extension() == ".png" || file.extension() == ".jpg"))
            return {
                {"color", picture(contents(file), file.extension() == ".png" ? "image/png" : "image/jpeg")}};
        Json result;
        if (bytes != nullptr) {
            result["color"] = plane(image, [&](std::size_t at) { return (*bytes)[at]; });
        } else {
            // Two bytes of a half each, in pictures of their own: a browser's would be rounded to one.
            const auto& floats = std::get<std::vector<float>>(image.pixels);
            result["color"] =
                plane(image, [&](std::size_t at) { return std::uint8_t(halfOf(floats[at]) >> 8); });
            result["low"] =
                plane(image, [&](std::size_t at) { return std::uint8_t(halfOf(floats[at]) & 255); });
        }
        if (has_alpha) result["alpha"] = alpha(image);
        return result;
    }

    std::string picture(const Image& image) {
        const fs::path file = folder_ / "picture.png";
        saveImage(file, image);
        return picture(contents(file), "image/png");
    }

    void close() {
        stream_.close();
        if (!stream_) throw std::runtime_error(file_.string() + ": cannot be written");
    }

  private:
    std::string picture(const std::string& bytes, const std::string& type) {
        std::string id = "p" + std::to_string(++pictures_);
        stream_ << "<script type=\"text/plain\" id=\"" << id << "\" data-type=\"" << type << "\">"
                << base64(bytes) << "</script>\n";
        return id;
    }

    // The colors of an image, grey as three, by a function of where a sample is.
    template <class Function>
    std::string plane(const Image& image, const Function& byte) {
        Image result{.width = image.width,
                     .height = image.height,
                     .channels = 3,
                     .color_space = ColorSpace::srgb,
                     .pixels = {}};
        const auto channels = static_cast<std::size_t>(image.channels);
        Bytes bytes;
        const std::size_t count =
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                bytes.push_back(byte(i * channels + (channels < 3 ? 0 : c)));
        result.pixels = std::move(bytes);
        return picture(result);
    }

    std::string alpha(const Image& image) {
        Image result{.width = image.width,
                     .height = image.height,
                     .channels = 1,
                     .color_space = ColorSpace::srgb,
                     .pixels = {}};
        Bytes bytes;
        for (const double value : measure::alpha(image).pixels)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0))));
        result.pixels = std::move(bytes);
        return picture(result);
    }

    fs::path file_;
    std::ofstream stream_;
    TemporaryFolder folder_;
    int pictures_ = 0;
};

// What the rule lets pass, for the histogram: of codes the two limits, of pixels how many.
void describeRule(const Rule& rule, std::size_t total, Json& json) {
    json["rule_codes"] = Json::array();
    json["rule_pixels"] = Json::array();
    if (rule.kind != Rule::Kind::count) return;
    json["rule_codes"] = {Rule::small_difference, rule.codes};
    json["rule_pixels"] = {rule.mostDiffering(total), rule.mostExceeding(total)};
}

Json describe(const CaseResult& result, const std::string& renderer, std::size_t id, Writer& writer) {
    constexpr std::array<const char*, 4> outcomes = {"same", "tolerated", "different", "incomparable"};
    Json json{{"id", id},
              {"name", result.fullName()},
              {"outcome", outcomes[static_cast<std::size_t>(result.outcome)]},
              {"why", result.why},
              {"rule", result.rule.text() + (result.rule.because.empty() ? "" : ": " + result.rule.because)},
              {"first", result.firstDifferent()},
              {"targets", Json::array()},
              {"settings", result.settings},
              {"hash", result.hash},
              {"reference_renderer", result.reference_renderer},
              {"renderer", renderer},
              {"render_line", result.render_line},
              {"bless_line", result.bless_line},
              {"frame_file", result.suite.empty() ? result.frame.string() : ""},
              {"reference_file", result.reference.string()},
              {"total", 0},
              {"differing", 0},
              {"histogram", Json::array()},
              {"worst", Json::array()},
              {"rmse", nullptr},
              {"psnr", nullptr},
              {"flip", nullptr},
              {"flip_map", nullptr}};
    for (const Target& target : result.targets)
        json["targets"].push_back({target.name, target.differs});
    if (result.measurement && result.measurement->comparison.comparable()) {
        const measure::Comparison& comparison = result.measurement->comparison;
        json["total"] = comparison.total();
        json["differing"] = comparison.differing();
        for (std::size_t codes = 1; codes < comparison.pixels.size(); ++codes)
            if (comparison.pixels[codes] > 0) json["histogram"].push_back({codes, comparison.pixels[codes]});
        for (const measure::PixelDifference& pixel : comparison.worst)
            json["worst"].push_back({pixel.x, pixel.y, pixel.codes});
        json["rmse"] = comparison.rmse;
        json["psnr"] = result.measurement->psnrDb();
        if (result.measurement->flip_mean) json["flip"] = *result.measurement->flip_mean;
        if (result.measurement->flip_map) json["flip_map"] = writer.picture(*result.measurement->flip_map);
        describeRule(result.rule, comparison.total(), json);
    } else {
        describeRule(result.rule, 0, json);
    }
    json["frame"] = writer.frame(result.frame);
    json["reference"] = writer.frame(result.reference);
    return json;
}

// JSON within a page's script: nothing in it may end that.
std::string scriptText(const Json& json) {
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
        text.replace(at, 1, "\\u003c");
    return text;
}

} // namespace

void writeReport(const fs::path& file, const std::string& title, const std::vector<SuiteResult>& suites,
                 bool for_review) {
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    const std::string page = report_page;
    const auto pictures_at = page.find("@PICTURES@");
    const auto data_at = page.find("@DATA@");
    const Counts counts = countsOf(suites);
    Json data{{"title", title},
              {"for_review", for_review},
              {"drawn_by", ""},
              {"knows_targets", false},
              {"counts",
               {{"same", counts.same},
                {"tolerated", counts.tolerated},
                {"different", counts.different},
                {"incomparable", counts.incomparable}}},
              {"problems", Json::array()},
              {"same", Json::array()},
              {"cases", Json::array()}};
    Writer writer(file);
    writer.text(page.substr(0, pictures_at));
    for (const SuiteResult& suite : suites) {
        if (!suite.renderer.empty()) data["drawn_by"] = "drawn by " + suite.renderer;
        for (const std::string& problem : suite.problems)
            data["problems"].push_back(suite.name + "/" + problem);
        for (const CaseResult& result : suite.cases) {
            if (!result.targets.empty()) data["knows_targets"] = true;
            if (result.outcome == Outcome::same)
                data["same"].push_back(result.fullName());
            else
                data["cases"].push_back(describe(result, suite.renderer, data["cases"].size(), writer));
        }
    }
    const auto after_pictures = pictures_at + std::string("@PICTURES@").size();
    writer.text(page.substr(after_pictures, data_at - after_pictures));
    writer.text(scriptText(data));
    writer.text(page.substr(data_at + std::string("@DATA@").size()));
    writer.close();
}

} // namespace gll::frame_check
