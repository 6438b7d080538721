// Writes a batch to a temporary file, runs this program on it and reads the reports.
#include "budget/pass_costs.hpp"

#include "process/process.hpp"

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <unistd.h>

namespace gll {
namespace {

// A file that is there as long as this is.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& text)
        : name_((std::filesystem::temp_directory_path() / "gl-ladder-XXXXXX").string()) {
        const int handle = mkstemp(name_.data());
        if (handle < 0)
            throw std::runtime_error(name_ + ": cannot be written; costs are measured through it");
        const bool whole = write(handle, text.data(), text.size()) == static_cast<ssize_t>(text.size());
        close(handle);
        if (whole) return;
        unlink(name_.c_str());
        throw std::runtime_error(name_ + ": cannot be written; make room there");
    }
    ~TemporaryFile() { unlink(name_.c_str()); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::string& name() const { return name_; }

  private:
    std::string name_;
};

PassCosts readReport(const nlohmann::json& report) {
    const auto pixels = [](const nlohmann::json& size) {
        return size.at(0).get<double>() * size.at(1).get<double>();
    };
    const double frame = pixels(report.at("size"));
    PassCosts passes;
    for (const auto& pass : report.at("passes"))
        passes[pass.at("name")] = {pass.at("cu"),
                                   pass.at("bytes_per_pixel").get<double>() * pixels(pass.at("size")) / frame,
                                   pass.at("program")};
    return passes;
}

} // namespace

Cost sumOf(const PassCosts& passes) {
    Cost sum;
    for (const auto& [name, cost] : passes) {
        sum.cu += cost.cu;
        sum.bytes += cost.bytes;
    }
    return sum;
}

std::optional<CountedPasses> countPasses(FrameRequest request,
                                         const std::vector<std::vector<std::string>>& settings,
                                         const std::string& context, const std::string& counter,
                                         const std::function<bool()>& interrupted) {
    std::string lines;
    for (const std::vector<std::string>& sets : settings)
        lines += nlohmann::json{{"cost", "passes"}, {"set", sets}}.dump() + "\n";
    const TemporaryFile file(lines);
    request.out.clear();                      // nothing is written twice
    request.last_frame = request.first_frame; // of a sequence, what the first one costs
    Command command = headlessCommand(request, context);
    command.arguments.insert(command.arguments.end(),
                             {"--batch", file.name(), "--json", "--counter", counter});
    Process process(command);
    std::optional<ProcessResult> result;
    while (!(result = process.poll())) {
        if (interrupted()) return std::nullopt;
        usleep(20'000);
    }
    if (result->exit_code != 0)
        throw std::runtime_error("measuring costs failed: " + result->err.substr(0, result->err.find('\n')));

    CountedPasses counted;
    std::istringstream printed(result->out);
    for (std::string text; std::getline(printed, text);) {
        const nlohmann::json report = nlohmann::json::parse(text);
        counted.counter = report.at("counter");
        counted.of_settings.push_back(readReport(report));
    }
    return counted;
}

} // namespace gll
