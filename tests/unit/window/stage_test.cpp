// Two sides of a rung that share its settings, and files that are dropped on it.
#include "../gl/gl_test.hpp"
#include "window/stage.hpp"

#include <stdexcept>

namespace gll::test {
namespace {

// Fills the frame with its setting; refuses a mesh that is called bad.obj.
class FlatRung final : public Rung {
  public:
    FlatRung(RungResources resources, const Number& gray) : gray_(gray) {
        if (resources.given.mesh == "bad.obj") throw std::runtime_error("bad.obj: is no mesh");
    }
    void render(Frame& frame) override {
        if (gray_ > 0.9F) throw std::runtime_error("too bright");
        frame.pass("flat", frame.presented(),
                   {.program = program_,
                    .uniforms = {{"flat_color", glm::vec4(glm::vec3(gray_), 1)}},
                    .clear_color = glm::vec4(0)});
    }

  private:
    Number gray_;
    Program program_ = makeProgram(full_screen_vertex, flat_fragment);
};

class StageTest : public GlTest {
  protected:
    float shown(int side) const { return pixelOf(stage.renderer(side).presented().color(), 0, 0).r; }
    bool render(int side, int frame = 1) {
        stage.prepare(side);
        return stage.render(side, frame, {4, 4}, nullptr, false);
    }

    Settings settings;
    Number gray = settings.number("gray", 0.2, 0, 1, "help");
    Number yaw = settings.number("yaw", 0, 0, 360, "help");
    RungInfo info{
        .name = "00_flat", .summary = "", .takes = {"mesh"}, .make = [this](RungResources resources) {
            return std::make_unique<FlatRung>(std::move(resources), gray);
        }};
    Stage stage{*context, info, settings, {}};
};

TEST_F(StageTest, eachSideHasItsSettings) {
    stage.edit(Stage::b);
    settings.set("gray", "0.6");
    EXPECT_TRUE(render(Stage::a));
    EXPECT_TRUE(render(Stage::b));
    EXPECT_NEAR(shown(Stage::a), 0.2F, 0.01F);
    EXPECT_NEAR(shown(Stage::b), 0.6F, 0.01F);
    EXPECT_EQ(settings.at("gray").text(), "0.6"); // the edited side's, whatever was rendered
    EXPECT_EQ(stage.differences(Stage::a), std::vector<std::string>{"gray=0.2"});
    stage.edit(Stage::a);
    EXPECT_EQ(settings.at("gray").text(), "0.2");
    stage.swap();
    EXPECT_EQ(stage.sets(Stage::a), std::vector<std::string>{"gray=0.6"});
    EXPECT_TRUE(stage.sets(Stage::b).empty());
    stage.copy(Stage::a, Stage::b);
    EXPECT_TRUE(stage.differences(Stage::a).empty());
    stage.applyPreset(Stage::b, "original");
    EXPECT_TRUE(stage.sets(Stage::b).empty());
    EXPECT_EQ(stage.sets(Stage::a), std::vector<std::string>{"gray=0.6"});
}

TEST_F(StageTest, onlyTheCameraIsShared) {
    settings.group(Setting::Group::camera, {"yaw"});
    settings.set("yaw", "90");
    settings.set("gray", "0.5");
    stage.shareCamera();
    EXPECT_EQ(stage.sets(Stage::b), std::vector<std::string>{"yaw=90"});
}

TEST_F(StageTest, aStateIsTheSettingsOfBothSides) {
    const History::State first = stage.state();
    stage.edit(Stage::b);
    EXPECT_EQ(stage.state(), first); // looking at the other side is no change
    settings.set("gray", "0.6");
    const History::State second = stage.state();
    EXPECT_NE(second, first);
    stage.setState(first);
    EXPECT_TRUE(stage.sets(Stage::b).empty());
    stage.setState(second);
    EXPECT_EQ(settings.at("gray").text(), "0.6");
    EXPECT_TRUE(stage.sets(Stage::a).empty());
}

TEST_F(StageTest, sharingTheCameraIsNoChangeOfItsOwn) {
    settings.group(Setting::Group::camera, {"yaw"});
    settings.set("yaw", "90");
    const History::State before = stage.state();
    stage.shareCamera();
    EXPECT_EQ(stage.state(), before);
}

TEST_F(StageTest, whatIsThereIsNotRenderedAgain) {
    EXPECT_TRUE(render(Stage::a));
    EXPECT_FALSE(render(Stage::a));
    EXPECT_EQ(stage.renderedCount(Stage::a), 1);
    EXPECT_TRUE(render(Stage::a, 2));
    EXPECT_EQ(stage.renderedCount(Stage::a), 2);
    settings.set("gray", "0.3");
    EXPECT_TRUE(render(Stage::a, 2));
    EXPECT_EQ(stage.rendered(Stage::a).sets, std::vector<std::string>{"gray=0.3"});
    EXPECT_TRUE(stage.render(Stage::a, 2, {4, 4}, nullptr, true));
}

TEST_F(StageTest, aFrameThatCannotBeDrawnSaysWhyAndEndsNothing) {
    settings.set("gray", "1");
    EXPECT_TRUE(render(Stage::a));
    EXPECT_FALSE(stage.isDrawn(Stage::a));
    ASSERT_EQ(stage.errors(Stage::a).size(), 1U);
    EXPECT_STREQ(stage.errors(Stage::a).front().what(), "too bright");
    EXPECT_FALSE(render(Stage::a)); // not over and over again
    settings.set("gray", "0.4");
    EXPECT_TRUE(render(Stage::a));
    EXPECT_TRUE(stage.isDrawn(Stage::a) && stage.errors(Stage::a).empty());
    EXPECT_NEAR(shown(Stage::a), 0.4F, 0.01F);
}

TEST_F(StageTest, aFileThatCannotBeReadLeavesTheSceneAsItIs) {
    render(Stage::a);
    RungFiles given;
    given.mesh = "bad.obj";
    EXPECT_THROW(stage.load(given), std::runtime_error);
    EXPECT_TRUE(stage.given().mesh.empty());
    EXPECT_NEAR(shown(Stage::a), 0.2F, 0.01F);
    given.mesh = "good.obj";
    stage.load(given);
    EXPECT_EQ(stage.given().mesh, "good.obj");
    EXPECT_TRUE(render(Stage::a)); // anew
    EXPECT_EQ(stage.renderedCount(Stage::a), 2);
    EXPECT_EQ(stage.rendered(Stage::a).files.mesh, "good.obj");
    EXPECT_TRUE(render(Stage::b));
}

TEST(DropTest, aFileGoesWhereTheRungTakesIt) {
    const auto option = [](const char* file, const std::set<std::string_view>& takes) {
        const FileOption* found = optionFor(file, takes);
        return found == nullptr ? std::string_view("none") : found->name;
    };
    const std::set<std::string_view> deferred = {"mesh", "floor", "environment"};
    EXPECT_EQ(option("a/Cat.GLB", deferred), "mesh");
    EXPECT_EQ(option("brick.mtl", deferred), "floor");
    EXPECT_EQ(option("sky.exr", deferred), "environment");
    EXPECT_EQ(option("photo.png", deferred), "none");
    EXPECT_EQ(option("sky.exr", {"image"}), "image");
    EXPECT_EQ(option("photo.JPEG", {"image"}), "image");
    EXPECT_EQ(option("cat.obj", {"image"}), "none");
    EXPECT_EQ(option("noending", deferred), "none");
    EXPECT_EQ(option("sky.hdr", {}), "none");
}

} // namespace
} // namespace gll::test
