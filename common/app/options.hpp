// The command line every rung has: parsing it, and the files of --batch, whose keys are the same options.
#pragma once

#include "app/rung.hpp"
#include "process/process.hpp"

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gll {

enum class ContextKind {
    window,
    headless,
    osmesa,
    egl
}; // headless: OSMesa, or EGL where that is not installed
enum class CounterKind { automatic, perf, callgrind, cpu, gpu };

// One pixel overwritten in the middle of a frame: to see how far a value that should not be there spreads.
struct Injection {
    std::string
        name; // a pass, whose first attachment is meant, or an attachment, at the first pass that draws it
    glm::ivec2 pixel{0}; // counted from the top left
    float value = 0;     // in every channel; may be infinite or not a number
};

// How far a frame may be from that of the best settings.
struct Budget {
    enum class Kind {
        flip, // mean FLIP of what a display shows, 0 to 1
        rmse, // root mean squared difference of display values, 0 to 1
        ev    // difference in exposure, stops; for rungs that meter
    };
    Kind kind = Kind::flip;
    double limit = 0;
};

// One frame, or a run of them, and what is to come of it.
struct FrameRequest {
    glm::ivec2 size{640, 480};
    int first_frame = 60;
    int last_frame = 60;
    int step = 1;
    std::string preset = "seed";
    std::vector<std::string> sets; // KEY=VALUE, applied over the preset in order
    std::filesystem::path out;     // empty: nothing is written; with a %d where there are several frames
    std::string target;            // empty: the presented frame; a target's name, or a pass's
    std::vector<Injection> injections;
    bool readings = false;
    bool cost = false;
    RungFiles files;
    std::string batch_line; // "FILE:line" of it

    bool isSequence() const { return first_frame != last_frame; }
    std::filesystem::path outFor(int frame) const; // out with its %d filled in
};

struct Options {
    ContextKind context = ContextKind::window;
    CounterKind counter = CounterKind::automatic;
    FrameRequest request;
    std::vector<FrameRequest> batch; // in place of request, where --batch was given
    bool is_batch = false;
    std::optional<Budget> budget;           // for the request; no batch then
    std::optional<FrameRequest> or_picture; // in place of the window, where none can be opened
    bool list_settings = false;
    bool json = false;
};

// Parses a command line. Returns nothing where --help or --version was asked for and printed. Throws
// UsageError for what is wrong with the command line or the batch file ("FILE:line: what"),
// std::runtime_error where the batch file cannot be read. Leaves the settings at their defaults: the requests
// say what to set.
std::optional<Options> parseOptions(int argc, char** argv, const RungInfo& info, Settings& settings);

// The other way round: this program and the options that ask for a request's size, first frame, settings and
// file, in a headless context ("osmesa", "egl", or "" for whichever is there). Files are named by their whole
// paths. Throws std::filesystem::filesystem_error.
Command headlessCommand(const FrameRequest& request, const RungFiles& files, const std::string& context);

// "NAME:X,Y:VALUE", VALUE a number, inf, -inf or nan. Throws UsageError.
Injection parseInjection(const std::string& text);

// "flip=0.01", "rmse=0.004" or "ev=0.05"; the limit above 0, at most 1 (16 for ev). Throws UsageError.
Budget parseBudget(const std::string& text);
const char* kindName(Budget::Kind kind); // "flip", "rmse" or "ev"

// A size such as "640x480": both sides 1 to 16384, at most 64 Mi pixels. Throws UsageError.
glm::ivec2 parseSize(const std::string& text);

} // namespace gll
