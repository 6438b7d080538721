// What the window shows: a rung's frame from the settings that are edited and, to compare it with, from
// others.
#pragma once

#include "rung/request.hpp"
#include "window/history.hpp"
#include "window/live_shaders.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace gll {

// The option under which a rung that takes those (see RungInfo) is given a file, by its ending; null where it
// takes none such. Light in a file is a sky where it takes skies, else a picture.
const FileOption* optionFor(const std::filesystem::path& file, const std::set<std::string_view>& takes);

class Stage {
  public:
    static constexpr int a = 0;
    static constexpr int b = 1;

    // The settings are always those of the side that is edited, which is A at first; B begins as A is.
    Stage(Context& context, const RungInfo& info, Settings& settings, RungFiles given);

    // Everything that undo brings back: the settings of both sides, with the camera of the one that is
    // edited.
    History::State state() const;
    void setState(const History::State& state);

    int edited() const { return edited_; }
    void edit(int side);
    void swap();
    void copy(int from, int to);
    void applyPreset(int side, const std::string& preset);
    void shareCamera();                            // the edited side's, with the other
    std::vector<std::string> sets(int side) const; // KEY=VALUE, what differs from the defaults
    void applySets(int side, const std::vector<std::string>& sets); // over the defaults; throws UsageError
    // The settings of a side that differ from the other's, as "tone_map=agx".
    std::vector<std::string> differences(int side) const;

    // Makes the side's renderer where it has none. Throws as load() does.
    void prepare(int side);
    // Renders a prepared side unless its frame is there already, its shaders are as they were, and it is not
    // asked for again. A frame that cannot be drawn ends nothing: errors() says why.
    bool render(int side, int frame, glm::ivec2 size, PassObserver* observer, bool again);
    Renderer& renderer(int side) const {
        return *sides_[static_cast<std::size_t>(side)].renderer;
    }                                                                     // prepared
    int renderedCount(int side) const { return at(side).rendered_count; } // frames drawn, or tried
    bool isRendered(int side) const { return sides_[static_cast<std::size_t>(side)].frame > 0; }
    bool isDrawn(int side) const; // the frame that was tried last
    std::vector<ShaderError> errors(int side) const;
    double timeMs(int side) const { return sides_[static_cast<std::size_t>(side)].time_ms; }
    // What asks for the frame of a side that was rendered last: a setting may have changed since.
    FrameRequest rendered(int side) const;

    // Makes the rung anew with other files, which it takes. Throws std::runtime_error for what cannot be
    // read, and goes on with those before.
    void load(const RungFiles& given);
    const RungFiles& given() const { return given_; }

    // The warnings said since this was last asked.
    std::vector<std::string> takeWarnings();

  private:
    struct Side {
        std::unique_ptr<Renderer> renderer = {}; // B's is made when it is first rendered
        History::State values = {};              // of the side that is not edited
        int frame = 0;
        glm::ivec2 size{0};
        std::vector<std::string> sets = {};
        std::unique_ptr<LiveShaders> live = {}; // goes before the renderer
        double time_ms = 0;
        int rendered_count = 0;
    };
    void make(Side& side, const RungFiles& given) const;
    Side& at(int side) { return sides_[static_cast<std::size_t>(side)]; }
    const Side& at(int side) const { return sides_[static_cast<std::size_t>(side)]; }
    History::State valuesOf(int side) const;
    void setValues(int side, const History::State& values);

    // Does something while the settings are those of a side.
    template <class Do>
    auto with(int side, const Do& act) const;

    Context& context_;
    const RungInfo& info_;
    Settings& settings_;
    RungFiles given_;
    std::array<Side, 2> sides_;
    int edited_ = a;
};

} // namespace gll
