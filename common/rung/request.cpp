// Requests: their settings, the names of their files, and the command line that asks for them again.
#include "rung/request.hpp"

#include "rung/usage_error.hpp"

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <optional>

namespace gll {
namespace {

// The place of a lone "%d" (or "%0Nd") in a file name: offset and length. Any other % is an error.
std::optional<std::pair<std::size_t, std::size_t>> findCounter(const std::string& name) {
    std::optional<std::pair<std::size_t, std::size_t>> place;
    for (std::size_t i = name.find('%'); i != std::string::npos; i = name.find('%', i + 1)) {
        std::size_t end = i + 1;
        while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end])) != 0 && end < i + 3)
            ++end;
        if (end >= name.size() || name[end] != 'd' || place)
            throw UsageError("--out " + name + ": only one %d (or %04d) may stand in it");
        place.emplace(i, end + 1 - i);
    }
    return place;
}

} // namespace

bool hasFrameNumber(const std::filesystem::path& out) { return findCounter(out.string()).has_value(); }

std::filesystem::path FrameRequest::outFor(int frame) const {
    std::string name = out.string();
    if (const auto place = findCounter(name)) {
        const std::string format = name.substr(place->first, place->second);
        char number[32];
        const int width = format.size() > 2 ? std::atoi(format.c_str() + 1) : 0;
        std::snprintf(number, sizeof number, "%0*d", width, frame);
        name.replace(place->first, place->second, number);
    }
    return name;
}

void FrameRequest::applyTo(Settings& settings) const {
    settings.applyPreset(preset);
    for (const std::string& set : sets)
        settings.set(set);
}

Command headlessCommand(const FrameRequest& request, const std::string& context) {
    Command command{.program = std::filesystem::read_symlink("/proc/self/exe"),
                    .arguments = {"--headless", "--preset", request.preset, "--size",
                                  std::to_string(request.size.x) + "x" + std::to_string(request.size.y)}};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) command.arguments.insert(command.arguments.end(), {option, value});
    };
    if (request.isSequence())
        add("--frames", std::to_string(request.first_frame) + ".." + std::to_string(request.last_frame) +
                            ":" + std::to_string(request.step));
    else
        add("--frame", std::to_string(request.first_frame));
    add("--context", context);
    for (const std::string& set : request.sets)
        add("--set", set);
    for (const FileOption& option : file_options)
        if (const std::filesystem::path& file = request.files.*option.file; !file.empty())
            add(("--" + std::string(option.name)).c_str(), std::filesystem::absolute(file));
    add("--out", request.out);
    return command;
}

} // namespace gll
