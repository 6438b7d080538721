// 01_hdr: a dark hall whose window is hundreds of times brighter than its walls, drawn into a target that
// keeps such values or one that does not, and brought into a display's range by a tone map.
#include "01_hdr/boxes.hpp"
#include "01_hdr/guard.hpp"
#include "01_hdr/tone_map.hpp"
#include "run/run.hpp"
#include "rung/camera.hpp"
#include "rung/scene_image.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace {
using namespace gll;
using namespace gll::hdr;

const std::vector<std::string> formats = {"rgba8", "rgb10_a2", "r11f_g11f_b10f", "rgba16f", "rgba32f"};

struct HdrOptions {
    Settings all;
    // excerpt: settings
    Choice format = all.choice("format", "rgba16f", formats, "what the scene is drawn into");
    ToneMapOptions display{all, "reinhard", "gamma22"};
    Guard guard{all};
    Choice view = all.choice("view", "picture", {"picture", "stops"},
                             "the picture, or luminance in bands of a stop with clipped pixels striped");
    Number brightness = all.number("brightness", 1, 0, 1e6, "factor on all light of the scene");
    OrbitSettings orbit{all};
    // end excerpt

    // What the charts show to be best; of the formats that is the original's own.
    HdrOptions() {
        all.group(Setting::Group::look, {"view", "brightness"});
        all.dial({"format", {"rgba32f", "rgba16f", "r11f_g11f_b10f", "rgb10_a2", "rgba8"}});
        all.preset({"recommended", "the tone map that turns hues least", {{"tone_map", "pbr_neutral"}}});
    }
};

// The lamps on the walls: each nearer one has a third of the light of the one before.
constexpr int lamp_count = 4;
constexpr float lamp_intensity[lamp_count] = {3, 1.2F, 0.5F, 0.2F};
const glm::vec3 lamp_color(1, 0.62F, 0.3F);
glm::vec3 lampPosition(int i) {
    return {i % 2 == 0 ? 2.55F : -2.55F, 2.3F, 2.6F + 2.6F * static_cast<float>(i)};
}

Mesh makeHall() {
    const glm::vec3 stone(0.62F, 0.58F, 0.52F);
    const glm::vec3 tile(0.34F, 0.31F, 0.29F);
    std::vector<Box> boxes = {{{-3.2F, -0.2F, -0.2F}, {3.2F, 0, 14}, tile},
                              {{-3.2F, 0, -0.2F}, {3.2F, 5.4F, 0}, stone},
                              {{-3.4F, 0, 0}, {-3, 5.4F, 14}, stone},
                              {{3, 0, 0}, {3.4F, 5.4F, 14}, stone},
                              {{-3, 5, 0}, {3, 5.4F, 14}, stone * 0.7F}};
    for (const float z : {1.3F, 3.9F, 6.5F, 9.1F}) {
        boxes.push_back({{-3, 4.55F, z - 0.22F}, {3, 5, z + 0.22F}, stone * 0.6F});
        for (const float x : {-2.3F, 2.3F}) {
            const auto block = [&](float half, float bottom, float top) {
                boxes.push_back({{x - half, bottom, z - half}, {x + half, top, z + half}, stone});
            };
            block(0.36F, 0, 0.35F);
            block(0.24F, 0.35F, 4.2F);
            block(0.36F, 4.2F, 4.55F);
        }
    }
    for (int i = 0; i < lamp_count; ++i) {
        const glm::vec3 half(0.05F, 0.12F, 0.05F);
        boxes.push_back({lampPosition(i) - half, lampPosition(i) + half, lamp_color, 20 * lamp_intensity[i]});
    }
    return makeBoxes(boxes);
}

class Hdr final : public Rung {
  public:
    using Options = HdrOptions;

    Hdr(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), image_(resources) {}

    void render(Frame& frame) override {
        // excerpt: target
        // Made anew where the format or the size has changed.
        hdr_.remake(
            {{.name = "hdr", .format = formatNamed(options_.format.name()), .filter = Filter::nearest},
             {.name = "hdr_depth", .format = Format::depth24, .filter = Filter::nearest}},
            frame.size());
        // end excerpt
        drawScene(frame);
        display(frame);
    }

  private:
    // excerpt: scene
    void drawScene(Frame& frame) {
        if (image_) return image_.draw(frame, "scene", hdr_);
        const float time_s = frame.time_s();
        const float sway = std::sin(time_s * 0.4F);
        const Camera camera = options_.orbit.apply({.position = {0.9F * sway, 1.75F, 11.2F},
                                                    .target = {-0.1F * sway, 2.25F, 0},
                                                    .vertical_field_of_view_deg = 46,
                                                    .near = 0.1F,
                                                    .far = 60});
        const glm::vec3 to_sun = glm::normalize(
            glm::vec3(0.25F * std::sin(time_s * 0.25F), 0.62F + 0.05F * std::cos(time_s * 0.2F), -1));
        std::vector<glm::vec3> positions;
        std::vector<glm::vec3> colors;
        for (int i = 0; i < lamp_count; ++i) {
            positions.push_back(lampPosition(i));
            colors.push_back(lamp_color * lamp_intensity[i]);
        }
        const float pixel_angle = 2 * std::tan(glm::radians(camera.vertical_field_of_view_deg) / 2) /
                                  static_cast<float>(frame.size().y);
        frame.pass(
            "scene", hdr_,
            {.program = shaders_.program("01_hdr/hall.vert", "01_hdr/hall.frag",
                                         {{"LAMPS", std::to_string(lamp_count)}}),
             .uniforms = {{"clip_from_world", camera.clipFromView(frame.aspect()) * camera.viewFromWorld()},
                          {"camera_position", camera.position},
                          {"to_sun", to_sun},
                          {"pixel_angle", pixel_angle},
                          {"brightness", options_.brightness},
                          {"lamp_position", positions},
                          {"lamp_color", colors}},
             .mesh = &hall_,
             .depth_test = DepthTest::less,
             .cull = Cull::back,
             .clear_color = glm::vec4(0, 0, 0, 1),
             .clear_depth = 1.0F});
    }
    // end excerpt

    // excerpt: display
    void display(Frame& frame) {
        const Program& program =
            shaders_.fullScreen("01_hdr/display.frag", options_.display.defines() + options_.guard.defines() +
                                                           options_.view.defines());
        frame.pass("display", frame.presented(),
                   {.program = program, .inputs = {{"hdr", hdr_.color()}}, .part = options_.display.part()});
    }
    // end excerpt

    ShaderLibrary& shaders_;
    const Options& options_;
    SceneImage image_; // --image
    Mesh hall_ = makeHall();
    Framebuffer hdr_;
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<Hdr>(argc, argv,
                         {.name = "01_hdr",
                          .summary = "A dark hall, a bright window: HDR targets and tone maps.",
                          .takes = {"image"}});
}
