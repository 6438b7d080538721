// 07_shadow_map: who sees the sun: depth from the light, comparing with it, and what has to be done so that
// surfaces do not shade themselves and shadows stay where they belong.
#include "01_hdr/tone_map.hpp"
#include "plot.hpp"
#include "run/run.hpp"
#include "shadow_map.hpp"

#include "rung/capture.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace {
using namespace gll;
using namespace gll::shadow_map;

struct Options {
    Settings all;
    ShadowOptions shadow{all};
    Choice scene = all.choice("scene", "cat", {"cat", "plot"},
                              "a cat on brick, or a plot that puts shadows to the test");
    Number sun_elevation_deg = all.number("sun_elevation_deg", 40, 1, 90, "of the sun above the ground");
    Number sun_azimuth_deg = all.number("sun_azimuth_deg", 75, -360, 360, "turns the sun about the vertical");
    Choice view =
        all.choice("view", "lit", {"lit", "sun", "shadow", "cascades"},
                   "the picture; how much of the sun is seen; the map; which cascade is read, by color");
    gbuffer::SceneOptions materials{all, gbuffer::Highlights::none};
    ToneMapOptions display{all, "aces_narkowicz", "srgb"};
    OrbitSettings orbit{all};

    Options() {
        all.group(Setting::Group::look, {"scene", "sun_elevation_deg", "sun_azimuth_deg", "view"});
        all.needs({"exposure_ev", "tone_map", "encode"}, {{"view", {"lit"}}});
        all.needs({"texture_filter", "flip_v"}, {{"scene", {"cat"}}});
        all.needs({"texture_filter", "flip_v"}, {{"view", {"lit", "sun", "cascades"}}});
        all.needs({"camera_yaw_deg", "camera_pitch_deg", "camera_zoom"},
                  {{"view", {"lit", "sun", "cascades"}}, {"shadow_fit", {"fitted", "stable"}}});
        all.preset({"recommended",
                    "no self-shadowing and no gap at any slope, without a number chosen for the scene",
                    {{"shadow_bias", "plane"}, {"shadow_pcf", "3"}, {"shadow_fit", "stable"}}});
        all.dial({"shadow_size", {"4096", "2048", "1024", "512", "256"}});
    }
};

// What the surfaces are read from: positions in 32 bits, as this rung is not about them.
struct Stored {
    Settings all;
    gbuffer::GBufferOptions gbuffer{all};

    Stored() {
        all.set("normals=oct16");
        all.set("positions=rgba32f");
    }
};

class Rung07 final : public Rung {
  public:
    using Options = ::Options;

    Rung07(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), cat_(resources), plot_(resources.warnings),
          gbuffer_(resources.shaders), shadow_(resources.shaders) {
        for (const gbuffer::PlainObject& object : makePlot())
            plot_.add(object);
    }

    // excerpt: render
    void render(Frame& frame) override {
        setUp(frame);
        gbuffer::Scene& scene = options_.scene == "cat" ? cat_ : plot_;
        shadow_.draw(frame, sun_, view_, scene.depthDraws(options_.materials), options_.shadow);
        gbuffer_.draw(frame, "geometry", view_, scene.materialDraws(options_.materials),
                      options_.materials.defines(), stored_.gbuffer);
        const ShaderPart part = gbuffer_.part(view_, stored_.gbuffer) + shadow_.part(sun_, options_.shadow);
        visible_.resize(frame.size());
        frame.pass("sun", visible_,
                   {.program = shaders_.fullScreen("07_shadow_map/sun.frag", part.defines), .part = part});
        present(frame, part);
    }
    // end excerpt

    // How many screen pixels the largest texel of shadow on a visible receiver is high, for 1 to 4 cascades
    // of the stable views, and the fewest with which it is at most one: 0 where none does.
    std::vector<Reading> readings() override {
        std::vector<Reading> readings;
        double needed = 0;
        for (int count = 1; count <= max_cascades; ++count) {
            Settings settings;
            ShadowOptions options(settings);
            settings.set("shadow_fit=stable");
            settings.set("shadow_size=" + std::to_string(int(options_.shadow.size)));
            settings.set("cascades=" + std::to_string(count));
            const double worst = pixelsPerTexel(sunViews(sun_, view_, options), options.size);
            readings.push_back({"pixels_per_texel_" + std::to_string(count), "px", worst});
            if (needed == 0 && worst <= 1) needed = count;
        }
        readings.push_back({"cascades_needed", "", needed});
        return readings;
    }

  private:
    void setUp(const Frame& frame) {
        const float time_s = frame.time_s();
        const float orbit_rad = time_s * 0.3F;
        const Camera cat = {.position = {4.6F * std::cos(orbit_rad), 2.3F, 4.6F * std::sin(orbit_rad)},
                            .target = {0, 1, 0},
                            .vertical_field_of_view_deg = 50,
                            .near = 0.1F,
                            .far = 60};
        const float sway_rad = 0.2F * std::sin(0.5F * time_s);
        const Camera plot = {.position = {6.4F * std::sin(sway_rad), 4.2F, 5.6F * std::cos(sway_rad)},
                             .target = {-0.3F, 0.3F, -0.3F},
                             .vertical_field_of_view_deg = 50,
                             .near = 0.1F,
                             .far = 60};
        view_ = gbuffer::View(options_.orbit.apply(options_.scene == "cat" ? cat : plot), frame.aspect());
        const float azimuth_rad = glm::radians(float(options_.sun_azimuth_deg)) + time_s * 0.25F;
        const float elevation_rad = glm::radians(float(options_.sun_elevation_deg));
        sun_.to_sun = {std::cos(elevation_rad) * std::cos(azimuth_rad), std::sin(elevation_rad),
                       std::cos(elevation_rad) * std::sin(azimuth_rad)};
        stored_.all.set("geometric", options_.shadow.usesGeometry() ? "on" : "off");
        sun_.half_width = options_.scene == "cat" ? 4 : 6;
    }

    void present(Frame& frame, ShaderPart part) {
        part += options_.display.part();
        part += {.defines = options_.view.defines(),
                 .inputs = {{"sun_map", visible_.color()}},
                 .uniforms = {{"aspect", frame.aspect()}}};
        frame.pass(
            "present", frame.presented(),
            {.program = shaders_.fullScreen("07_shadow_map/present.frag", part.defines), .part = part});
    }

    double pixelsPerTexel(const std::vector<SunView>& views, int size) const {
        const Image positions = readTexture(gbuffer_.target()["position"]);
        const auto& values = std::get<std::vector<float>>(positions.pixels);
        const double pixel_at_one =
            2.0 / (view_.clip_from_view[1][1] * float(positions.height)); // world units, 1 unit away
        double worst = 0;
        for (std::size_t i = 0; i < values.size(); i += 4) {
            if (values[i + 3] == 0.0F) continue; // background
            const glm::vec4 position(values[i], values[i + 1], values[i + 2], 1);
            const double distance = -(view_.view_from_world * position).z;
            if (distance > double(sun_.receivers_far)) continue;
            const SunView* seen_by = &views.back();
            for (auto view = views.rbegin(); view != views.rend(); ++view) {
                const glm::vec3 clip(view->clipFromWorld() * position);
                if (glm::all(glm::lessThan(glm::abs(glm::vec2(clip)), glm::vec2(0.98F)))) seen_by = &*view;
            }
            worst = std::max(worst, double(seen_by->texel(size)) / (pixel_at_one * distance));
        }
        return worst;
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    Stored stored_;
    gbuffer::Scene cat_;
    gbuffer::Scene plot_;
    gbuffer::GBuffer gbuffer_;
    ShadowMap shadow_;
    Framebuffer visible_{{{.name = "sun", .format = Format::r16f, .filter = Filter::nearest}}, {1, 1}};
    gbuffer::View view_{Camera(), 1}; // of the frame being drawn
    Sun sun_;
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<Rung07>(argc, argv,
                            {.name = "07_shadow_map",
                             .summary = "Who sees the sun: depth from the light, bias, soft edges, cascades.",
                             .takes = {"mesh", "floor"}});
}
