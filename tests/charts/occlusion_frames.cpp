// Rendering what 08_ssao makes of its scenes, and shooting the rays.
#include "charts/occlusion_frames.hpp"

#include "08_ssao/room.hpp"

namespace gll::charts {

void OcclusionFrames::run(int rays) {
    for (OcclusionView& view : views_) {
        const auto ask = [&](Set set, const std::string& target) {
            set["scene"] = view.scene;
            set["view"] = "visibility";
            return frames_.ask(set, size_, target, nullptr, view.frame);
        };
        const Set geometric = {{"ssao_normals", "geometric"}};
        view.depth = ask(geometric, "depth");
        view.normals = ask(geometric, "geometric");
        for (const Set& set : sets_)
            view.visible.push_back(ask(set, "lit"));
    }
    frames_.run();
    for (OcclusionView& view : views_) {
        const Camera camera = ssao::cameraOf(view.scene, static_cast<float>(view.frame / frames_per_second));
        view.truth.width = size_.x;
        view.truth.points =
            truth::seenPoints(camera, frames_.read(view.depth), loadImage(frames_.file(view.normals)));
        view.truth.visibility = truth::trueVisibility(*truth::occlusionScene(view.scene), view.truth.points,
                                                      occlusion_radius, rays);
        view.truth.on_screen =
            truth::trueVisibility(*truth::heightField(view.truth.points, size_.x, occlusion_radius),
                                  view.truth.points, occlusion_radius, rays);
    }
}

truth::OcclusionErrors OcclusionFrames::errors(std::size_t set, const std::string& scene) const {
    truth::OcclusionErrors errors;
    for (std::size_t i = 0; i < views_.size(); ++i)
        if (scene.empty() || views_[i].scene == scene)
            truth::addErrors(errors, views_[i].truth, visible(set, i));
    return errors;
}

} // namespace gll::charts
