// 09_environment_light: the light of a whole sky on matt and on glossy surfaces, summed up beforehand so that
// a pixel needs two or three fetches for what is an integral over everything around it.
#include "01_hdr/tone_map.hpp"
#include "balls.hpp"
#include "environment.hpp"
#include "run/run.hpp"

#include <glm/matrix.hpp>
#include <map>

namespace {
using namespace gll;
using namespace gll::environment_light;

struct Options {
    Settings all;
    EnvironmentOptions light{all};
    Choice sky = all.choice("sky", "file", {"file", "furnace", "sun"},
                            "the picture; 1 from everywhere; a dim sky with a sun 21 stops brighter");
    Choice view = all.choice("view", "lit", {"lit", "irradiance", "radiance"},
                             "the picture; what matt surfaces would gather; what glossy ones gather");
    ToneMapOptions display{all, "pbr_neutral", "srgb"};
    OrbitSettings orbit{all};

    Options() {
        all.group(Setting::Group::look, {"sky", "view"});
        all.needs({"environment_diffuse"}, {{"view", {"lit", "irradiance"}}});
        all.needs({"environment_specular"}, {{"view", {"lit", "radiance"}}});
        all.needs({"environment_brdf"}, {{"view", {"lit"}}});
        all.preset({"recommended",
                    "within a percent of the integrals but for what every split sum leaves out",
                    {{"environment_diffuse", "sh9_sun"},
                     {"environment_specular", "prefiltered"},
                     {"prefilter_samples", "32"},
                     {"environment_sun", "on"},
                     {"environment_brdf", "table"},
                     {"environment_energy", "fdez_aguera"}}});
        all.dial({"environment_diffuse", {"sh9_sun", "sh9_windowed", "sh9", "mip"}});
        all.dial({"environment_brdf", {"table", "karis", "lazarov"}});
    }
};

class Rung09 final : public Rung {
  public:
    using Options = ::Options;

    Rung09(RungResources resources, const Options& options) : shaders_(resources.shaders), options_(options) {
        environments_.try_emplace("file", resources.file(&RungFiles::environment, "assets/sky/sky.hdr"),
                                  resources.warnings);
    }

    // excerpt: render
    void render(Frame& frame) override {
        hdr_.resize(frame.size());
        const Camera camera = options_.orbit.apply(ballsCamera(frame.time_s()));
        const glm::mat4 clip_from_world = camera.clipFromView(frame.aspect()) * camera.viewFromWorld();
        ShaderPart part = environment().part(options_.light);
        part += {.defines = options_.view.defines(),
                 .uniforms = {{"camera_position", camera.position},
                              {"clip_from_world", clip_from_world},
                              {"world_from_clip", glm::inverse(clip_from_world)}}};
        frame.pass("sky", hdr_,
                   {.program = shaders_.fullScreen("09_environment_light/sky.frag"),
                    .part = part,
                    .clear_depth = 1.0F});
        frame.pass("balls", hdr_,
                   {.program = shaders_.program("09_environment_light/balls.vert",
                                                "09_environment_light/balls.frag", part.defines),
                    .part = part,
                    .mesh = &mesh_,
                    .instances = static_cast<int>(ball_list_.size()),
                    .depth_test = DepthTest::less});
        frame.pass("present", frame.presented(),
                   {.program = shaders_.fullScreen("lib/present.frag",
                                                   options_.display.defines() + Defines{{"BLOOM", "0"}}),
                    .inputs = {{"hdr", hdr_.color()}},
                    .part = options_.display.part()});
    }
    // end excerpt

    // What the light is stored in, all maps and tables that the settings read.
    std::vector<Reading> readings() override {
        return {{"environment_bytes", "bytes", environment().bytes()}};
    }

  private:
    Environment& environment() {
        const std::string& name = options_.sky.name();
        const auto found = environments_.find(name);
        if (found != environments_.end()) return found->second;
        return environments_.try_emplace(name, name == "furnace" ? furnace() : smallSun()).first->second;
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    std::map<std::string, Environment> environments_; // by the setting; made when first asked for
    std::vector<Ball> ball_list_ = balls();
    Mesh mesh_ = makeBalls(ball_list_);
    Framebuffer hdr_{{{.name = "hdr", .format = Format::rgba16f, .filter = Filter::nearest},
                      {.name = "depth", .format = Format::depth24, .filter = Filter::nearest}},
                     {1, 1}};
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<Rung09>(argc, argv,
                            {.name = "09_environment_light",
                             .summary = "The light of a whole sky on balls from mirror to chalk.",
                             .takes = {"environment"}});
}
