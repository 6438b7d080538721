// What a frame costs: instructions, copies and bytes for each pass. See tutorials/MEASURING.md.
#pragma once

#include "rung/rung.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gll {

enum class CounterKind { automatic, perf, callgrind, cpu, gpu };
inline const std::vector<std::string> counter_names = {"auto", "perf", "callgrind", "cpu", "gpu"};
inline const std::string& counterName(CounterKind kind) { return counter_names.at(std::size_t(kind)); }

struct PassCost {
    std::string name;
    glm::ivec2 size{1, 1};
    double amount = 0; // of the report's unit, for the whole pass
    double bytes_per_pixel = 0;
    double time_ms = 0;   // wall time, or the GPU's own; the shortest of the repetitions
    unsigned program = 0; // passes of one process with the same one run the same shaders
};

// "amount" is counted in unit: "instructions" (user space), "ns" of CPU time or "ns" of GPU time.
struct CostReport {
    std::string rung;
    std::string renderer;
    std::string counter; // "perf", "callgrind", "cpu" or "gpu"
    std::string note;    // why not the one that was hoped for; may be empty
    std::string unit;
    int frame = 0;
    glm::ivec2 size{1, 1};
    double copy_per_pixel = 0; // one copy (cu): a one-tap RGBA16F full-screen copy, per pixel
    std::vector<PassCost> passes;
    // The frame rendered whole, without a wait between passes; nothing where only passes were counted.
    std::optional<double> frame_amount = {};
    double frame_time_ms = 0;
};

// Before the first context: makes Mesa's rasteriser work in the calling thread, so that counting that thread
// counts everything. With CounterKind::callgrind outside valgrind, runs the program anew under it and exits
// as that did; throws std::runtime_error where valgrind is not there.
void prepareCost(CounterKind counter, char** argv);

// Renders the frame several times and measures it, pass by pass and, unless passes_only, whole. Throws
// std::runtime_error where the counter asked for is not to be had here.
CostReport measureCost(Renderer& renderer, const RungInfo& info, int frame, glm::ivec2 size,
                       CounterKind counter, bool passes_only = false);

std::string costTable(const CostReport& report); // for people, ends in a newline
std::string costJson(const CostReport& report);  // one line, ends in a newline

} // namespace gll
