// What is asked of a rung: a frame or a run of them, from which settings and files, and what is to come of
// it.
#pragma once

#include "process/process.hpp"
#include "rung/rung.hpp"

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace gll {

// One pixel overwritten in the middle of a frame: to see how far a value that should not be there spreads.
struct Injection {
    std::string
        name; // a pass, whose first attachment is meant, or an attachment, at the first pass that draws it
    glm::ivec2 pixel{0}; // counted from the top left
    float value = 0;     // in every channel; may be infinite or not a number

    bool operator==(const Injection&) const = default;
};

struct FrameRequest {
    glm::ivec2 size{640, 480};
    int first_frame = 60;
    int last_frame = 60;
    int step = 1;
    std::string preset = "original";
    std::vector<std::string> sets; // KEY=VALUE, applied over the preset in order
    std::filesystem::path out;     // empty: nothing is written; with a %d where there are several frames
    std::string target;            // empty: the presented frame; a target's name, or a pass's
    std::filesystem::path targets; // empty, or the folder for what every pass has drawn, one after the other
    std::vector<Injection> injections;
    bool readings = false;
    bool cost = false;
    bool passes_only = false; // of the cost: the whole frame, which takes as long, is not counted by itself
    RungFiles files;
    std::string batch_line; // "FILE:line" of it

    bool isSequence() const { return first_frame != last_frame; }
    // out with its %d filled in. Throws UsageError for any other % in it.
    std::filesystem::path outFor(int frame) const;
    // The preset, then the sets. Throws UsageError as Settings::set() does.
    void applyTo(Settings& settings) const;

    bool operator==(const FrameRequest&) const = default;
};

// Whether the name of a file to write has a place for the frame's number: a lone %d or %0Nd. Throws
// UsageError for any other % in it.
bool hasFrameNumber(const std::filesystem::path& out);

// This program and the options that ask for a request's size, first frame, settings and files, in a headless
// context ("osmesa", "egl", or "" for whichever is there). Files are named by their whole paths. Throws
// std::filesystem::filesystem_error.
Command headlessCommand(const FrameRequest& request, const std::string& context);

} // namespace gll
