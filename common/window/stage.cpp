// Two sides of one rung, which share its settings: each has its values while it is rendered.
#include "window/stage.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <utility>

namespace gll {
namespace {

History::State valuesIn(const Settings& settings) {
    History::State values;
    for (const Setting& setting : settings.all())
        values.push_back(setting.value);
    return values;
}

void put(const History::State& values, Settings& settings) {
    for (std::size_t i = 0; i < values.size(); ++i)
        settings.all()[i].value = values[i];
}

// Puts the settings back as they were, also where something throws.
class SettingsBack {
  public:
    explicit SettingsBack(Settings& settings) : settings_(settings), before_(valuesIn(settings)) {}
    ~SettingsBack() { put(before_, settings_); }
    SettingsBack(const SettingsBack&) = delete;
    SettingsBack& operator=(const SettingsBack&) = delete;

  private:
    Settings& settings_;
    History::State before_;
};

} // namespace

const FileOption* optionFor(const std::filesystem::path& file, const std::set<std::string_view>& takes) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto isOneOf = [&](std::initializer_list<const char*> some) {
        return std::find(some.begin(), some.end(), extension) != some.end();
    };
    const bool is_light = isOneOf({".hdr", ".exr"});
    const auto isFor = [&](std::string_view option) {
        if (option == "mesh") return isOneOf({".obj", ".gltf", ".glb"});
        if (option == "floor") return isOneOf({".mtl"});
        if (option == "environment") return is_light;
        return is_light || isOneOf({".png", ".jpg", ".jpeg", ".tga", ".bmp"});
    };
    for (const FileOption& option : file_options) // skies stand before pictures
        if (takes.contains(option.name) && isFor(option.name)) return &option;
    return nullptr;
}

template <class Do>
auto Stage::with(int side, const Do& act) const {
    const SettingsBack scope(settings_);
    put(valuesOf(side), settings_);
    return act();
}

Stage::Stage(Context& context, const RungInfo& info, Settings& settings, RungFiles given)
    : context_(context), info_(info), settings_(settings), given_(std::move(given)) {
    make(at(a), given_);
    at(b).values = valuesIn(settings_);
}

History::State Stage::valuesOf(int side) const {
    return side == edited_ ? valuesIn(settings_) : at(side).values;
}

void Stage::setValues(int side, const History::State& values) {
    if (side == edited_)
        put(values, settings_);
    else
        at(side).values = values;
}

History::State Stage::state() const {
    History::State state = valuesOf(a);
    History::State other = valuesOf(b);
    History::State& not_edited = edited_ == a ? other : state;
    for (std::size_t i = 0; i < state.size(); ++i)
        if (const Setting& setting = settings_.all()[i]; setting.group == Setting::Group::camera)
            not_edited[i] = setting.value;
    state.insert(state.end(), other.begin(), other.end());
    return state;
}

void Stage::setState(const History::State& state) {
    const auto middle = state.begin() + static_cast<std::ptrdiff_t>(settings_.all().size());
    setValues(a, {state.begin(), middle});
    setValues(b, {middle, state.end()});
}

void Stage::edit(int side) {
    if (side == edited_) return;
    at(edited_).values = valuesIn(settings_);
    edited_ = side;
    put(at(side).values, settings_);
}

void Stage::swap() {
    const History::State values_a = valuesOf(a);
    setValues(a, valuesOf(b));
    setValues(b, values_a);
}

void Stage::copy(int from, int to) { setValues(to, valuesOf(from)); }

void Stage::applyPreset(int side, const std::string& preset) {
    const auto values = with(side, [&] {
        settings_.applyPreset(preset);
        return valuesIn(settings_);
    });
    setValues(side, values);
}

void Stage::shareCamera() {
    History::State& other = at(edited_ == a ? b : a).values;
    for (std::size_t i = 0; i < other.size(); ++i)
        if (const Setting& setting = settings_.all()[i]; setting.group == Setting::Group::camera)
            other[i] = setting.value;
}

std::vector<std::string> Stage::sets(int side) const {
    return with(side, [&] { return settings_.changed(); });
}

void Stage::applySets(int side, const std::vector<std::string>& sets) {
    const auto values = with(side, [&] {
        settings_.reset();
        for (const std::string& set : sets)
            settings_.set(set);
        return valuesIn(settings_);
    });
    setValues(side, values);
}

std::vector<std::string> Stage::differences(int side) const {
    const History::State other = valuesOf(side == a ? b : a);
    return with(side, [&] {
        std::vector<std::string> texts;
        for (std::size_t i = 0; i < other.size(); ++i)
            if (const Setting& setting = settings_.all()[i]; setting.value != other[i])
                texts.push_back(setting.name + "=" + setting.text());
        return texts;
    });
}

void Stage::make(Side& side, const RungFiles& given) const {
    side.live.reset();
    side.renderer = std::make_unique<Renderer>(context_, info_, given);
    side.live = std::make_unique<LiveShaders>(info_.name, side.renderer->shaders());
}

bool Stage::isDrawn(int side) const { return at(side).live && at(side).live->isDrawn(); }

std::vector<ShaderError> Stage::errors(int side) const {
    return at(side).live ? at(side).live->errors() : std::vector<ShaderError>();
}

void Stage::prepare(int side) {
    if (!at(side).renderer) with(side, [&] { make(at(side), given_); });
}

bool Stage::render(int side, int frame, glm::ivec2 size, PassObserver* observer, bool again) {
    Side& one = at(side);
    const std::vector<std::string> sets_now = sets(side);
    const bool is_edited = one.live->update();
    if (!again && !is_edited && frame == one.frame && size == one.size && sets_now == one.sets) return false;
    one.frame = frame;
    one.size = size;
    one.sets = sets_now;
    ++one.rendered_count;
    const auto start = std::chrono::steady_clock::now();
    with(side, [&] { one.live->attempt([&] { one.renderer->render(frame, size, observer); }); });
    if (context_.info().is_software) glFinish();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    one.time_ms = elapsed.count();
    return true;
}

FrameRequest Stage::rendered(int side) const {
    FrameRequest request;
    request.size = at(side).size;
    request.first_frame = request.last_frame = at(side).frame;
    request.sets = at(side).sets;
    request.files = given_;
    return request;
}

void Stage::load(const RungFiles& given) {
    Side fresh;
    make(fresh, given);
    fresh.values = at(a).values;
    fresh.rendered_count = at(a).rendered_count; // which goes on, so that no two frames have the same
    given_ = given;
    at(a).live.reset(); // before the renderer that it watches for
    at(b).live.reset();
    at(a) = std::move(fresh);
    Side other;
    other.values = at(b).values;
    other.rendered_count = at(b).rendered_count;
    at(b) = std::move(other);
}

std::vector<std::string> Stage::takeWarnings() {
    std::vector<std::string> warnings;
    for (Side& side : sides_) {
        if (!side.renderer) continue;
        for (std::string& warning : side.renderer->takeWarnings())
            if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
                warnings.push_back(std::move(warning));
    }
    return warnings;
}

} // namespace gll
