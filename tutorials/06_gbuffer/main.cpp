// 06_gbuffer: a yard lit after it was drawn, from what a G-buffer holds of it; what that stores, and in how
// many bits, and what each choice does to the picture.
#include "01_hdr/tone_map.hpp"
#include "gbuffer.hpp"
#include "run/run.hpp"
#include "yard.hpp"

#include <cmath>

namespace {
using namespace gll;
using namespace gll::gbuffer;

struct Options {
    Settings all;
    GBufferOptions gbuffer{all};
    SceneOptions scene{all};
    Number floor_shininess = all.number("floor_shininess", 24, 1, 8192, "exponent of the floor's highlights");
    Choice view = all.choice("view", "lit",
                             {"lit", "albedo", "specular", "normal", "geometric", "gloss", "position",
                              "depth", "lit_error", "normal_error", "position_error"},
                             "the picture; what is stored, full screen; or how far it is from 32-bit floats");
    Number amplify = all.number("amplify", 32, 1, 10000, "factor on what the error views show");
    ToneMapOptions display{all, "aces_narkowicz", "srgb"};
    OrbitSettings orbit{all};

    Options() {
        all.group(Setting::Group::look, {"floor_shininess", "view", "amplify"});
        all.needs({"packing", "texture_filter", "flip_v"},
                  {{"view", {"lit", "albedo", "specular", "normal", "lit_error", "normal_error"}}});
        all.needs({"normals"}, {{"view", {"lit", "normal", "lit_error", "normal_error"}}});
        all.needs({"gloss"}, {{"view", {"lit", "gloss", "specular", "lit_error"}}});
        all.needs({"specular_aa", "floor_shininess"}, {{"view", {"lit", "gloss", "lit_error"}}});
        all.needs({"specular_aa", "floor_shininess"},
                  {{"gloss", {"float", "8", "6", "4"}}, {"packing", {"rgba16"}}});
        all.needs({"albedo"}, {{"view", {"lit", "albedo", "specular", "lit_error"}}});
        all.needs({"geometric"}, {{"view", {"geometric"}}});
        all.needs({"amplify"}, {{"view", {"lit_error", "normal_error", "position_error"}}});
        all.needs({"exposure_ev", "tone_map"}, {{"view", {"lit", "lit_error"}}});
        all.needs({"encode"}, {{"view", {"lit", "lit_error", "albedo"}}});
        all.preset({"recommended",
                    "twelve bytes a pixel; at most one lit pixel in a thousand shows a difference",
                    {{"packing", "rgba16"}, {"positions", "depth24"}}});
        all.dial({"normals", {"rgba32f", "rgba16f", "oct16", "rgb10", "oct12", "oct10", "rgb8", "oct8"}});
        all.dial({"positions", {"rgba32f", "linear", "depth32f", "depth24", "rgba16f", "depth16"}});
        all.dial({"gloss", {"float", "8", "6", "4"}});
        all.dial({"albedo", {"float", "root10", "srgb", "linear"}});
    }

    bool showsError() const { return view.name().ends_with("_error"); }
};

// The layout that the others are measured by: 32 bits for everything.
struct Reference {
    Settings all;
    GBufferOptions gbuffer{all};

    Reference() {
        for (const char* set : {"normals=rgba32f", "positions=rgba32f", "albedo=float"})
            all.set(set);
    }
};

class Rung06 final : public Rung {
  public:
    using Options = ::Options;

    Rung06(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), scene_(resources, floor_half_width),
          gbuffer_(resources.shaders), reference_gbuffer_(resources.shaders) {
        for (const PlainObject& object : makeYard())
            scene_.add(object);
    }

    // excerpt: render
    void render(Frame& frame) override {
        setUp(frame);
        scene_.setFloorShininess(options_.floor_shininess);
        const std::vector<Draw> draws = scene_.materialDraws(options_.scene);
        gbuffer_.draw(frame, "geometry", view_, draws, options_.scene.defines(), options_.gbuffer);
        const ShaderPart stored = gbuffer_.part(view_, options_.gbuffer);
        light(frame, "lighting", lit_, stored);
        if (options_.showsError()) {
            reference_gbuffer_.draw(frame, "reference", view_, draws, options_.scene.defines(),
                                    reference_.gbuffer);
            light(frame, "reference_lighting", reference_lit_,
                  reference_gbuffer_.part(view_, reference_.gbuffer));
        }
        present(frame, stored);
    }
    // end excerpt

  private:
    static constexpr float floor_half_width = 1000;

    // The camera sways in front of the cat; the sun stands still.
    void setUp(const Frame& frame) {
        const float sway_rad = 0.35F * std::sin(0.4F * frame.time_s());
        const Camera scripted = {.position = {6.2F * std::sin(sway_rad), 1.9F, 6.2F * std::cos(sway_rad)},
                                 .target = {0, 1, 0},
                                 .vertical_field_of_view_deg = 50,
                                 .near = 0.1F,
                                 .far = 1000};
        view_ = View(options_.orbit.apply(scripted), frame.aspect());
    }

    void light(Frame& frame, const std::string& pass, Framebuffer& target, const ShaderPart& gbuffer) {
        target.resize(frame.size());
        frame.pass(pass, target,
                   {.program = shaders_.fullScreen("06_gbuffer/lighting.frag", gbuffer.defines),
                    .uniforms = {{"to_sun", glm::normalize(glm::vec3(-0.5F, 0.75F, 0.6F))}},
                    .part = gbuffer});
    }

    void present(Frame& frame, const ShaderPart& stored) {
        ShaderPart part = options_.display.part();
        part += {.defines = options_.view.defines(),
                 .inputs = {{"lit_map", lit_.color()}},
                 .uniforms = {{"amplify", options_.amplify}}};
        part += stored;
        if (options_.showsError())
            part.inputs.insert(part.inputs.end(),
                               {{"reference_lit_map", reference_lit_.color()},
                                {"reference_normal_map", reference_gbuffer_.target()["normal"]},
                                {"reference_position_map", reference_gbuffer_.target()["position"]}});
        frame.pass("present", frame.presented(),
                   {.program = shaders_.fullScreen("06_gbuffer/present.frag", part.defines), .part = part});
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    Reference reference_;
    Scene scene_;
    GBuffer gbuffer_;
    GBuffer reference_gbuffer_;
    Framebuffer lit_{{{.name = "lit", .format = Format::rgba16f, .filter = Filter::nearest}}, {1, 1}};
    Framebuffer reference_lit_{
        {{.name = "reference_lit", .format = Format::rgba16f, .filter = Filter::nearest}}, {1, 1}};
    View view_{Camera(), 1}; // of the frame being drawn
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<Rung06>(
        argc, argv,
        {.name = "06_gbuffer",
         .summary = "What a G-buffer stores, in how many bits, and what that does to the picture.",
         .takes = {"mesh", "floor"}});
}
