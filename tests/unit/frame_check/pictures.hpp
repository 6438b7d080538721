// Small pictures for checks of checks, and a suite whose program copies them.
#pragma once

#include "frame_check/suite.hpp"
#include "io/image.hpp"
#include "process/temporary_folder.hpp"

#include <string>
#include <vector>

namespace gll::test {

inline Image grey(int width = 320, int height = 240) {
    return {.width = width,
            .height = height,
            .channels = 3,
            .color_space = ColorSpace::srgb,
            .pixels = std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height) * 3, 100)};
}

// The first `count` pixels changed by `codes`, in their last channel.
inline Image changed(int count, int codes, Image image = grey()) {
    auto& bytes = std::get<std::vector<std::uint8_t>>(image.pixels);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        bytes[3 * i + 2] = static_cast<std::uint8_t>(100 + codes);
    return image;
}

// A suite in a folder whose frames are the pictures in drawn/, copied by cp: NAME.png becomes the frame of
// case NAME.
class CopyingSuite {
  public:
    CopyingSuite() {
        std::filesystem::create_directories(drawn());
        folder_.write("suite.json", R"({"command": ["cp", "{suite_path}/drawn/{name}.png", "{out}"],
            "renderer": ["echo", "a copying machine"], "variables": {"suite_path": ")" +
                                        folder_.path().string() + "\"}}");
    }
    std::filesystem::path path() const { return folder_ / "cases"; }
    std::filesystem::path drawn() const { return folder_ / "drawn"; }
    void draws(const std::string& name, const Image& image) const {
        saveImage(drawn() / (name + ".png"), image);
    }
    void writeCase(const std::string& name, const std::string& json) const {
        folder_.write(std::filesystem::path("cases") / (name + ".json"), json);
    }
    frame_check::Suite suite() const { return frame_check::readSuites(path(), {}, true).at(0); }

  private:
    TemporaryFolder folder_;
};

} // namespace gll::test
