// 08_ssao: how much of the light from all round reaches a place, judged from what the screen shows round it;
// six ways to do so, and what each makes of rays.
#include "01_hdr/tone_map.hpp"
#include "06_gbuffer/scene.hpp"
#include "room.hpp"
#include "run/run.hpp"
#include "ssao.hpp"

namespace {
using namespace gll;
using namespace gll::ssao;

struct Options {
    Settings all;
    SsaoOptions ssao{all};
    Choice scene = all.choice("scene", "cat", {"cat", "room", "corner"},
                              "a cat on brick, a room that puts occlusion to the test, two planes");
    Choice view = all.choice("view", "lit", {"lit", "visibility"},
                             "what the sky lights, or the share of its light that arrives");
    gbuffer::SceneOptions materials{all, gbuffer::Highlights::none};
    ToneMapOptions display{all, "aces_narkowicz", "srgb"};
    OrbitSettings orbit{all};

    Options() {
        all.group(Setting::Group::look, {"scene", "view"});
        all.needs({"exposure_ev", "tone_map", "ssao_multi_bounce"}, {{"view", {"lit"}}});
        all.needs({"texture_filter", "flip_v"}, {{"scene", {"cat"}}});
        all.preset({"recommended",
                    "close to rays, by twelve taps and a blur",
                    {{"ssao", "bitmask"},
                     {"ssao_normals", "geometric"},
                     {"ssao_noise", "interleaved"},
                     {"ssao_blur", "separable"},
                     {"ssao_samples", "12"},
                     {"ssao_slices", "1"},
                     {"ssao_bias", "0.003"}}});
        all.dial({"ssao_samples", {"48", "24", "16", "12", "6"}});
        all.dial({"ssao_resolution", {"full", "half"}});
    }
};

// What the surfaces are read from: this rung is not about it.
struct Stored {
    Settings all;
    gbuffer::GBufferOptions gbuffer{all};

    Stored() {
        all.set("normals=oct16");
        all.set("positions=depth24");
    }
};

class Rung08 final : public Rung {
  public:
    using Options = ::Options;

    Rung08(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), cat_(resources), room_(resources.warnings),
          corner_(resources.warnings), gbuffer_(resources.shaders), ssao_(resources.shaders) {
        for (const gbuffer::PlainObject& object : makeRoom())
            room_.add(object);
        for (const gbuffer::PlainObject& object : makeCorner())
            corner_.add(object);
    }

    // excerpt: render
    void render(Frame& frame) override {
        setUp(frame);
        gbuffer_.draw(frame, "geometry", view_, scene().materialDraws(options_.materials),
                      options_.materials.defines(), stored_.gbuffer);
        const ShaderPart gbuffer = gbuffer_.part(view_, stored_.gbuffer);
        ssao_.draw(frame, view_, gbuffer, options_.ssao);
        light(frame, gbuffer + ssao_.part(view_, options_.ssao));
        present(frame);
    }
    // end excerpt

  private:
    gbuffer::Scene& scene() {
        return options_.scene == "cat" ? cat_ : options_.scene == "room" ? room_ : corner_;
    }

    void setUp(const Frame& frame) {
        view_ = gbuffer::View(options_.orbit.apply(cameraOf(options_.scene.name(), frame.time_s())),
                              frame.aspect());
        stored_.all.set(options_.ssao.usesGeometry() ? "geometric=on" : "geometric=off");
    }

    void light(Frame& frame, ShaderPart part) {
        part += {.defines = options_.view.defines()};
        lit_.resize(frame.size());
        frame.pass("lighting", lit_,
                   {.program = shaders_.fullScreen("08_ssao/lighting.frag", part.defines), .part = part});
    }

    void present(Frame& frame) {
        ShaderPart part = options_.display.part();
        part += {.defines = options_.view.defines(), .inputs = {{"lit_map", lit_.color()}}};
        frame.pass("present", frame.presented(),
                   {.program = shaders_.fullScreen("08_ssao/present.frag", part.defines), .part = part});
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    Stored stored_;
    gbuffer::Scene cat_, room_, corner_;
    gbuffer::GBuffer gbuffer_;
    Ssao ssao_;
    Framebuffer lit_{{{.name = "lit", .format = Format::rgba16f, .filter = Filter::nearest}}, {1, 1}};
    gbuffer::View view_{Camera(), 1}; // of the frame being drawn
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<Rung08>(
        argc, argv,
        {.name = "08_ssao",
         .summary = "Ambient occlusion on the screen: six methods, and rays to judge them.",
         .takes = {"mesh", "floor"}});
}
