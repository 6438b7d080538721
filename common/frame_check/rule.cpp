// Reading rules, and applying them.
#include "frame_check/rule.hpp"

#include "measure/errors.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

namespace gll::frame_check {
namespace {

// How many times fewer pixels may differ by more than small_difference than may differ at all.
constexpr double exceeding_in = 48;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

double within(const std::string& what, double value, double most) {
    if (!(value >= 0 && value <= most))
        throw std::runtime_error("a rule's " + what + " is " + number(value) + ", give 0 to " + number(most) +
                                 ": what is further off is another picture");
    return value;
}

Rule withLimit(const std::string& kind, double limit) {
    Rule rule{.kind = kind == "flip" ? Rule::Kind::flip : Rule::Kind::rmse};
    rule.limit = within(kind, limit, kind == "flip" ? most_rule_flip : most_rule_rmse);
    return rule;
}

double numberIn(const nlohmann::json& json, const std::string& what) {
    if (!json.is_number()) throw std::runtime_error("a rule's " + what + " is no number");
    return json.get<double>();
}

Rule countRule(const nlohmann::json& knobs) {
    if (!knobs.is_object())
        throw std::runtime_error("\"count\" wants an object with \"codes\" and \"pixels\"");
    Rule rule;
    for (const auto& [name, value] : knobs.items()) {
        if (name == "codes")
            rule.codes = static_cast<int>(within("codes", numberIn(value, name), most_rule_codes));
        else if (name == "pixels")
            rule.share = within("pixels", numberIn(value, name), most_rule_share);
        else
            throw std::runtime_error("\"" + name + "\" is no knob of \"count\"; there is codes, pixels");
    }
    return rule;
}

Image bytesOf(const measure::ScalarImage& map) {
    Image image{.width = map.width,
                .height = map.height,
                .channels = 1,
                .color_space = ColorSpace::srgb,
                .pixels = {}};
    std::vector<std::uint8_t> bytes;
    bytes.reserve(map.pixels.size());
    for (const double error : map.pixels)
        bytes.push_back(static_cast<std::uint8_t>(std::ceil(255 * error)));
    image.pixels = std::move(bytes);
    return image;
}

} // namespace

bool Rule::isLoosened() const {
    return kind == Kind::flip || kind == Kind::rmse ||
           (kind == Kind::count && (codes > usual_codes || share > usual_share));
}

// A share of whole pixels: without the small slack, 0.5 % of 800 pixels would be 3.
std::size_t Rule::mostDiffering(std::size_t pixels) const {
    return static_cast<std::size_t>(share * static_cast<double>(pixels) * (1 + 1e-12));
}

std::size_t Rule::mostExceeding(std::size_t pixels) const {
    return static_cast<std::size_t>(share * static_cast<double>(pixels) / exceeding_in * (1 + 1e-12));
}

std::string Rule::text() const {
    switch (kind) {
    case Kind::exact:
        return "exact";
    case Kind::flip:
        return "flip=" + number(limit);
    case Kind::rmse:
        return "rmse=" + number(limit);
    case Kind::count:
        break;
    }
    if (codes == usual_codes && share == usual_share) return "count";
    return "count, " + std::to_string(codes) + " codes, " + number(100 * share) + " % of the pixels";
}

Rule ruleFromText(const std::string& text) {
    if (text == "count") return {};
    if (text == "exact") return {.kind = Rule::Kind::exact};
    const auto equals = text.find('=');
    const std::string kind = text.substr(0, equals);
    if (equals != std::string::npos && (kind == "flip" || kind == "rmse")) {
        const char* value = text.c_str() + equals + 1;
        char* end = nullptr;
        const double limit = std::strtod(value, &end);
        if (end != value && *end == '\0') return withLimit(kind, limit);
    }
    throw std::runtime_error("\"" + text + "\" is no rule; there is count, exact, flip=X, rmse=X");
}

Rule ruleFromJson(const nlohmann::json& json) {
    Rule rule;
    if (json.is_string()) {
        rule = ruleFromText(json.get<std::string>());
    } else {
        std::string kind;
        if (json.is_object())
            for (const auto& [name, value] : json.items()) {
                if (name == "because") continue;
                if (!kind.empty() || (name != "count" && name != "flip" && name != "rmse"))
                    throw std::runtime_error(
                        "a rule is one of count, flip and rmse, and \"because\"; not \"" + name + "\"");
                kind = name;
                rule = name == "count" ? countRule(value) : withLimit(name, numberIn(value, name));
            }
        if (kind.empty()) throw std::runtime_error("\"rule\" wants a text or an object with one rule");
        if (json.contains("because")) {
            if (!json.at("because").is_string()) throw std::runtime_error("\"because\" wants a text");
            rule.because = json.at("because");
        }
    }
    if (rule.isLoosened() && rule.because.find_first_not_of(" \t\n") == std::string::npos)
        throw std::runtime_error("the rule " + rule.text() +
                                 " is looser than count, say why: {..., \"because\": \"...\"}");
    return rule;
}

double Measurement::psnrDb() const { return measure::psnrDb(comparison.rmse); }

std::string Measurement::line() const {
    if (!comparison.comparable()) return comparison.incomparable;
    char text[200];
    const auto total = static_cast<double>(comparison.total());
    int length = std::snprintf(text, sizeof text, "differ %zu (%.3g %%)", comparison.differing(),
                               100 * static_cast<double>(comparison.differing()) / total);
    std::string line(text, static_cast<std::size_t>(length));
    if (comparison.identical()) return line;
    length = std::snprintf(text, sizeof text, "  worst %d at (%d,%d)  RMSE %.3g  PSNR %.1f dB",
                           comparison.largest(), comparison.worst.front().x, comparison.worst.front().y,
                           comparison.rmse, psnrDb());
    line.append(text, static_cast<std::size_t>(length));
    std::snprintf(text, sizeof text, "  FLIP %.3g", flip_mean.value_or(0));
    return line + (flip_mean ? text : "  FLIP none, a color is not finite");
}

Measurement measure(const Image& reference, const Image& image, bool keep_map) {
    Measurement result{.comparison = measure::compare(reference, image)};
    if (!result.comparison.comparable()) return result;
    if (result.comparison.identical()) {
        result.flip_mean = 0;
        return result;
    }
    try {
        const measure::ScalarImage map = measure::flipMap(image, reference);
        result.flip_mean = std::accumulate(map.pixels.begin(), map.pixels.end(), 0.0) /
                           static_cast<double>(map.pixels.size());
        if (keep_map) result.flip_map = bytesOf(map);
    } catch (const std::invalid_argument&) { // a color is infinite or not a number: no error can be computed
    }
    return result;
}

bool satisfies(const Rule& rule, const Measurement& measurement) {
    const measure::Comparison& comparison = measurement.comparison;
    if (!comparison.comparable()) return false;
    if (comparison.identical()) return true;
    switch (rule.kind) {
    case Rule::Kind::exact:
        return false;
    case Rule::Kind::flip:
        return measurement.flip_mean && *measurement.flip_mean <= rule.limit;
    case Rule::Kind::rmse:
        return measurement.flip_mean && comparison.rmse <= rule.limit;
    case Rule::Kind::count:
        break;
    }
    return comparison.differing() <= rule.mostDiffering(comparison.total()) &&
           comparison.differingByMoreThan(Rule::small_difference) <= rule.mostExceeding(comparison.total()) &&
           comparison.largest() <= rule.codes;
}

} // namespace gll::frame_check
