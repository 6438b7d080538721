// Frames of a rung, rendered many to a process and read back as linear light.
#pragma once

#include "measure/raster.hpp"
#include "support/temporary_folder.hpp"

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace gll::charts {

using Set = std::map<std::string, std::string>; // settings by name

// Collects frames to render; run() renders all of them in one process.
class Frames {
  public:
    // arguments: such as --image FILE, for all of the frames.
    explicit Frames(std::filesystem::path rung, std::vector<std::string> arguments = {})
        : rung_(std::move(rung)), arguments_(std::move(arguments)) {}

    // Asks for a frame; returns its number. target as --target has it, in full range; inject as --inject has
    // it, one or a list of them.
    std::size_t ask(const Set& set, glm::ivec2 size, const std::string& target,
                    const nlohmann::json& inject = nullptr, int frame = 60,
                    const std::string& preset = "original");
    void run();
    // Valid after run(). Throws where a value is not finite, naming it.
    measure::ColorImage read(std::size_t number) const;
    std::filesystem::path file(std::size_t number) const {
        return folder_ / (std::to_string(number) + ".exr");
    }

  private:
    std::filesystem::path rung_;
    std::vector<std::string> arguments_;
    test::TemporaryFolder folder_;
    std::string lines_;
    std::size_t count_ = 0;
};

// What each pass of a frame costs in copies (cu), by the program's own --cost under callgrind: exact, and
// slow.
std::vector<nlohmann::json> costs(const std::filesystem::path& rung, const std::vector<Set>& sets,
                                  glm::ivec2 size, const std::vector<std::string>& more_arguments = {});

// A picture sampled as GL_LINEAR with clamped edges does, at another size: what a last pass does with a bloom
// of half the frame's size.
measure::ColorImage resized(const measure::ColorImage& source, int width, int height);

// An .exr of linear light, for --image.
void writeExr(const std::filesystem::path& file, const measure::ColorImage& image);

// A progress line on stderr where that is a terminal.
void sayProgress(const std::string& what);

} // namespace gll::charts
