// Contexts: errors become exceptions, and making, using and destroying them again and again leaves nothing.
#include "gl_test.hpp"

#include <cstddef>
#include <cstdio>
#include <dlfcn.h>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

namespace gll::test {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true; // freed memory stays in quarantine; the sanitizer finds leaks by itself
#else
constexpr bool sanitized = false;
#endif

double residentMiB() {
    std::ifstream stream("/proc/self/statm");
    long total = 0;
    long resident = 0;
    stream >> total >> resident;
    return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

std::ptrdiff_t openFiles() { return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}); }

// A frame that uses a little of everything: float target with depth, a texture, blending, two sizes.
Image smallFrame() {
    const Program gradient = makeProgram(full_screen_vertex, R"(#version 330 core
in vec2 uv;
out vec4 color;
void main() { color = vec4(uv * 3.0, exp(-uv.x * uv.y), 1.0); }
)");
    const Program blur = makeProgram(full_screen_vertex, R"(#version 330 core
in vec2 uv;
uniform sampler2D source;
out vec4 color;
void main() { color = 0.3 * texture(source, uv * 1.1); }
)");
    const Mesh triangle = Mesh::fullScreenTriangle();
    const Framebuffer first({{"a"}, {"depth", Format::depth24}}, {61, 47});
    const Framebuffer second({{"b"}}, {32, 32});
    drawPass("first", first, {.program = gradient, .clear_depth = 1.0F}, triangle);
    drawPass("second", second, {.program = gradient}, triangle);
    drawPass("add", second, {.program = blur, .inputs = {{"source", first.color()}}, .blend = Blend::add},
             triangle);
    return readTexture(second.color());
}

// EGL unloads its driver with the display, and LeakSanitizer then finds what Mesa left (some 250 bytes a
// display) in an unknown module, which no suppression can name. Keep the driver loaded, so that
// tests/lsan.supp knows it.
void keepDriverLoaded() {
    if (!sanitized) return;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);)
        if (const auto path = line.find('/'); path != line.npos && line.find("_dri.so") != line.npos)
            dlopen(line.c_str() + path, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
}

// Mesa from 25.1 on has none.
bool hasOsmesa() { return makeHeadlessContext()->kind() == std::string("osmesa"); }

TEST(ContextTest, osmesaAndEglGiveTheSameFrame) {
    if (!hasOsmesa()) GTEST_SKIP() << "libOSMesa.so.8 is not installed";
    Image osmesa;
    Image egl;
    {
        const auto context = makeOsmesaContext();
        EXPECT_STREQ(context->kind(), "osmesa");
        EXPECT_TRUE(context->info().is_software);
        osmesa = smallFrame();
        context->debugLog().check("osmesa");
    }
    {
        const auto context = makeEglContext();
        keepDriverLoaded();
        EXPECT_STREQ(context->kind(), "egl");
        egl = smallFrame();
        context->debugLog().check("egl");
    }
    EXPECT_EQ(osmesa.pixels, egl.pixels);
}

TEST(ContextTest, fiftyContextsOfEitherKindLeaveNoFileNoMemoryAndTheSameFrame) {
    const auto once = [](int i) {
        const auto context = i % 2 == 0 ? makeHeadlessContext() : makeEglContext();
        Image frame = smallFrame();
        context->debugLog().check("context " + std::to_string(i));
        return frame;
    };
    const Image expected = once(0);
    for (int i = 1; i < 10; ++i) // what libraries keep for good is kept by now
        once(i);
    const std::ptrdiff_t files_before = openFiles();
    const double before_mib = residentMiB();
    for (int i = 0; i < 100; ++i)
        ASSERT_EQ(once(i).pixels, expected.pixels) << "context " << i;
    EXPECT_EQ(openFiles(), files_before);
    const double grown_mib = residentMiB() - before_mib;
    RecordProperty("resident_growth_mib", std::to_string(grown_mib));
    std::printf("100 contexts: resident memory grew by %.2f MiB\n", grown_mib);
    if (!sanitized) {
        EXPECT_LT(grown_mib, 10); // a leaked context alone holds more than 0.5 MiB
    }
}

TEST(ContextTest, twoHundredResizesLeaveNoErrorNoMemoryAndTheSameFrame) {
    const auto context = makeHeadlessContext();
    const Mesh triangle = Mesh::fullScreenTriangle();
    const Program program = makeProgram(full_screen_vertex, R"(#version 330 core
in vec2 uv;
out vec4 color;
void main() { color = vec4(uv, 2.0, 1.0); }
)");
    Framebuffer target({{"a"}, {"b", Format::rgba8}, {"depth", Format::depth24}}, {1, 1});
    const auto frame = [&](glm::ivec2 size) {
        target.resize(size);
        drawPass("frame", target, {.program = program, .clear_color = glm::vec4(0), .clear_depth = 1.0F},
                 triangle);
        return readTexture(target.color());
    };
    const Image small = frame({1, 1});
    const Image large = frame({640, 480});
    for (int i = 0; i < 20; ++i)
        frame(i % 2 == 0 ? glm::ivec2(1, 1) : glm::ivec2(640, 480));
    const double before_mib = residentMiB();
    for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(frame({1, 1}).pixels, small.pixels);
        ASSERT_EQ(frame({640, 480}).pixels, large.pixels);
        ASSERT_NO_THROW(context->debugLog().check("resize " + std::to_string(i)));
    }
    const double grown_mib = residentMiB() - before_mib;
    std::printf("200 resizes: resident memory grew by %.2f MiB\n", grown_mib);
    if (!sanitized) {
        EXPECT_LT(grown_mib, 16); // one leaked set of attachments is 4.7 MiB
    }
}

TEST(DebugLogTest, anOpenGlErrorBecomesAnExceptionOnceWithThePlaceAsked) {
    const auto context = makeHeadlessContext();
    EXPECT_NO_THROW(context->debugLog().check("nothing yet"));
    glEnable(GL_TEXTURE_2D + 0x7777);
    const std::string message = messageOf<std::runtime_error>([&] { context->debugLog().check("my place"); });
    EXPECT_TRUE(message.starts_with("my place: ")) << message;
    EXPECT_CONTAINS(message, "GL_INVALID_ENUM");
    EXPECT_EQ(message.find('\n'), message.npos);
    EXPECT_NO_THROW(context->debugLog().check("forgotten after being told"));
}

TEST(DebugLogTest, aStormOfErrorsIsToldAsItsFirst) {
    const auto context = makeHeadlessContext();
    glViewport(0, 0, -1, -1);
    for (int i = 0; i < 1000; ++i)
        glEnable(0xFFFF);
    EXPECT_CONTAINS(messageOf<std::runtime_error>([&] { context->debugLog().check("storm"); }),
                    "GL_INVALID_VALUE");
    EXPECT_NO_THROW(context->debugLog().check("after the storm"));
}

} // namespace
} // namespace gll::test
