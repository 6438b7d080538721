// Frames of 08_ssao, and what is true of them by rays.
#pragma once

#include "charts/frames.hpp"
#include "truth/occlusion_errors.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gll::charts {

inline constexpr float occlusion_radius = 0.6F; // the rung's default, world units

// A view of a scene, and the frames of it that were asked for.
struct OcclusionView {
    std::string scene;
    int frame = 60;
    std::size_t depth = 0, normals = 0;    // numbers of frames
    std::vector<std::size_t> visible = {}; // one a set
    truth::TrueOcclusion truth = {};
};

// What several settings make of several views, one picture for each of both.
class OcclusionFrames {
  public:
    OcclusionFrames(const std::filesystem::path& rung, std::vector<OcclusionView> views, glm::ivec2 size)
        : frames_(rung), views_(std::move(views)), size_(size) {}

    void ask(const Set& set) { sets_.push_back(set); }
    // Renders what was asked for and shoots so many rays a pixel, twice.
    void run(int rays);

    // Over all views, or those of one scene.
    truth::OcclusionErrors errors(std::size_t set, const std::string& scene = {}) const;
    const std::vector<OcclusionView>& views() const { return views_; }
    measure::ColorImage visible(std::size_t set, std::size_t view) const {
        return frames_.read(views_[view].visible[set]);
    }

  private:
    Frames frames_;
    std::vector<OcclusionView> views_;
    glm::ivec2 size_;
    std::vector<Set> sets_;
};

} // namespace gll::charts
