// Counting what passes cost: hardware instructions, valgrind's count, CPU time or GPU timer queries.
#include "run/cost.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <linux/perf_event.h>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#if __has_include(<valgrind/callgrind.h>)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#include <valgrind/callgrind.h>
#pragma GCC diagnostic pop
#define GLLADDER_HAS_CALLGRIND 1
#else
#define GLLADDER_HAS_CALLGRIND 0
#endif

namespace gll {
namespace {

constexpr const char* callgrind_log_variable = "GLLADDER_CALLGRIND_LOG";

double clockMs(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

// Counts between start() and stop(), of everything OpenGL was asked to do in between.
class Counter {
  public:
    virtual ~Counter() = default;
    virtual const char* name() const = 0;
    virtual const char* unit() const { return "instructions"; }
    virtual int repetitions() const { return 3; } // the smallest count is kept
    virtual void warmedUp() {}                    // all is compiled, counting can begin
    virtual void start() = 0;
    virtual double stop() = 0;
};

// User-space instructions of this thread from the processor's own counter (perf_event_open(2)).
class PerfCounter final : public Counter {
  public:
    PerfCounter() {
        perf_event_attr attributes{};
        attributes.size = sizeof attributes;
        attributes.type = PERF_TYPE_HARDWARE;
        attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
        attributes.exclude_kernel = 1;
        attributes.exclude_hv = 1;
        file_ = static_cast<int>(syscall(SYS_perf_event_open, &attributes, 0, -1, -1, 0));
        if (file_ < 0)
            throw std::runtime_error(std::string("no hardware instruction counter here (") +
                                     std::strerror(errno) + ")");
    }
    ~PerfCounter() override { close(file_); }
    PerfCounter(const PerfCounter&) = delete;
    PerfCounter& operator=(const PerfCounter&) = delete;
    const char* name() const override { return "perf"; }
    void start() override {
        glFinish();
        start_ = read();
    }
    double stop() override {
        glFinish();
        return double(read() - start_);
    }

  private:
    std::uint64_t read() const {
        std::uint64_t value = 0;
        if (::read(file_, &value, sizeof value) != sizeof value)
            throw std::runtime_error("the hardware instruction counter cannot be read");
        return value;
    }
    int file_ = -1;
    std::uint64_t start_ = 0;
};

#if GLLADDER_HAS_CALLGRIND
// The same count by valgrind's callgrind, under which this process then runs: exact, and some fifty times
// slower.
class CallgrindCounter final : public Counter {
  public:
    CallgrindCounter() {
        const char* file = std::getenv(callgrind_log_variable);
        if (RUNNING_ON_VALGRIND == 0 || file == nullptr)
            throw std::runtime_error("not running under valgrind");
        log_.open(file, std::ios::ate); // behind the answers to an earlier frame of the batch
    }
    // Until here nothing was instrumented: shaders compile five times as fast. Every start or stop makes
    // valgrind translate the whole program anew, so that from the first count on it stays.
    void warmedUp() override { CALLGRIND_START_INSTRUMENTATION; }
    const char* name() const override { return "callgrind"; }
    int repetitions() const override { return 1; }
    // Only what callgrind has counted so far is asked for, before and after: clearing and dumping what it
    // keeps of every function takes as long as a small frame. The answers stand in its log.
    void start() override {
        glFinish();
        ask();
    }
    double stop() override {
        glFinish();
        ask();
        const double before = answer();
        return answer() - before;
    }

  private:
    static void ask() { (void)VALGRIND_MONITOR_COMMAND("status internal"); }

    // The next answer's count for the thread that asked; drivers have others, which store what was compiled.
    double answer() {
        std::string thread;
        for (std::string line; std::getline(log_, line);) {
            if (line.starts_with("current-tid: ")) thread = "events-" + line.substr(13) + ": ";
            if (!thread.empty() && line.starts_with(thread)) return std::stod(line.substr(thread.size()));
        }
        throw std::runtime_error("callgrind does not say what it counted; valgrind 3.19 does");
    }

    std::ifstream log_;
};
#endif

// CPU time of this thread: repeats within some percent, so the shortest of many.
class CpuCounter final : public Counter {
  public:
    const char* name() const override { return "cpu"; }
    const char* unit() const override { return "ns"; }
    int repetitions() const override { return 9; }
    void start() override {
        glFinish();
        start_ms_ = clockMs(CLOCK_THREAD_CPUTIME_ID);
    }
    double stop() override {
        glFinish();
        return (clockMs(CLOCK_THREAD_CPUTIME_ID) - start_ms_) * 1e6;
    }

  private:
    double start_ms_ = 0;
};

// The GPU's own clock. Software rasterisers answer such queries with nonsense.
class GpuCounter final : public Counter {
  public:
    GpuCounter() { glGenQueries(1, &query_); }
    ~GpuCounter() override { glDeleteQueries(1, &query_); }
    GpuCounter(const GpuCounter&) = delete;
    GpuCounter& operator=(const GpuCounter&) = delete;
    const char* name() const override { return "gpu"; }
    const char* unit() const override { return "ns"; }
    int repetitions() const override { return 15; }
    void start() override {
        glFinish();
        glBeginQuery(GL_TIME_ELAPSED, query_);
    }
    double stop() override {
        glEndQuery(GL_TIME_ELAPSED);
        GLuint64 elapsed_ns = 0;
        glGetQueryObjectui64v(query_, GL_QUERY_RESULT, &elapsed_ns);
        return double(elapsed_ns);
    }

  private:
    GLuint query_ = 0;
};

std::unique_ptr<Counter> makeCounter(CounterKind kind, bool software, std::string& note) {
    switch (kind) {
    case CounterKind::perf:
        return std::make_unique<PerfCounter>();
    case CounterKind::cpu:
        return std::make_unique<CpuCounter>();
    case CounterKind::gpu:
        if (software)
            throw std::runtime_error("--counter gpu: this is a software rasteriser, which has no GPU clock");
        return std::make_unique<GpuCounter>();
    case CounterKind::callgrind:
#if GLLADDER_HAS_CALLGRIND
        return std::make_unique<CallgrindCounter>();
#else
        throw std::runtime_error(
            "--counter callgrind: built without valgrind's headers (Debian package valgrind)");
#endif
    case CounterKind::automatic:
        break;
    }
    if (!software) return std::make_unique<GpuCounter>();
    try {
        return std::make_unique<PerfCounter>();
    } catch (const std::runtime_error& error) {
        note = std::string(error.what()) + ": CPU time instead; --counter callgrind counts exactly";
        return std::make_unique<CpuCounter>();
    }
}

// Measures every pass of a frame by itself, keeping the smallest amount and the shortest time of each.
class PassMeter final : public PassObserver {
  public:
    explicit PassMeter(Counter& counter) : counter_(counter) {}

    void begin() { next_ = 0; }
    void before(const std::string&) override {
        counter_.start();
        start_ms_ = clockMs(CLOCK_MONOTONIC);
    }
    void after(const DrawnPass& pass) override {
        const double amount = counter_.stop();
        const double time_ms = clockMs(CLOCK_MONOTONIC) - start_ms_;
        if (next_ == passes.size())
            passes.push_back(
                {pass.name, pass.target->size(), amount, pass.bytes_per_pixel, time_ms, pass.program});
        PassCost& kept = passes[next_++];
        kept.amount = std::min(kept.amount, amount);
        kept.time_ms = std::min(kept.time_ms, time_ms);
    }

    std::vector<PassCost> passes;

  private:
    Counter& counter_;
    std::size_t next_ = 0;
    double start_ms_ = 0;
};

std::string aligned(const std::string& text, std::size_t width, bool left = false) {
    const std::string space(width > text.size() ? width - text.size() : 0, ' ');
    return left ? text + space : space + text;
}

std::string fixed(double value, int digits) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.*f", digits, value);
    return buffer;
}

double area(glm::ivec2 size) { return double(size.x) * double(size.y); }

double copies(const CostReport& report, double amount) {
    return amount / (report.copy_per_pixel * area(report.size));
}

} // namespace

void prepareCost(CounterKind counter, char** argv) {
    setenv("LP_NUM_THREADS", "0", 1);
    if (counter != CounterKind::callgrind || std::getenv(callgrind_log_variable) != nullptr) return;
    char folder[] = "/tmp/gl-ladder-XXXXXX";
    if (mkdtemp(folder) == nullptr)
        throw std::runtime_error("/tmp: no folder can be made there for callgrind");
    const std::string log = std::string(folder) + "/log";
    if (isatty(fileno(stderr)) != 0)
        std::fputs("counting under valgrind, which takes a minute or so for each frame size\n", stderr);

    std::signal(SIGINT, SIG_IGN); // Ctrl-C reaches the child; this process stays to tidy up
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGINT, SIG_DFL);
        prctl(PR_SET_PDEATHSIG, SIGKILL); // who ends the waiting process means this one
        setenv(callgrind_log_variable, log.c_str(), 1);
        std::vector<std::string> words = {"valgrind",
                                          "--tool=callgrind",
                                          "--instr-atstart=no",
                                          "--separate-threads=yes",
                                          "-q",
                                          "--log-file=" + log,
                                          "--callgrind-out-file=/dev/null"};
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        for (char** argument = argv; *argument != nullptr; ++argument)
            arguments.push_back(*argument);
        arguments.push_back(nullptr);
        execvp("valgrind", arguments.data());
        _exit(127);
    }
    int status = 0;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
    if (child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
        throw std::runtime_error("--counter callgrind: valgrind cannot be started (Debian package valgrind)");
    std::exit(WIFEXITED(status) ? WEXITSTATUS(status) : 130);
}

CostReport measureCost(Renderer& renderer, const RungInfo& info, int frame, glm::ivec2 size, CounterKind kind,
                       bool passes_only) {
    const GlInfo& gl = renderer.context().info();
    CostReport report;
    report.rung = info.name;
    report.renderer = gl.renderer;
    const std::unique_ptr<Counter> counter = makeCounter(kind, gl.is_software, report.note);
    report.counter = counter->name();
    report.unit = counter->unit();
    report.frame = frame;
    report.size = size;

    const Framebuffer from({{.name = "from", .format = Format::rgba16f}}, size);
    const Framebuffer to({{.name = "to", .format = Format::rgba16f}}, size);
    const Pass copy{.program = renderer.shaders().fullScreen("lib/copy.frag"),
                    .inputs = {{"source", from.color()}}};
    const auto copyOnce = [&] { drawPass("copy", to, copy, renderer.fullScreenTriangle()); };

    // Once for the compiler, whose work no later frame has to do again.
    copyOnce();
    renderer.render(frame, size);
    glFinish();
    counter->warmedUp();

    PassMeter meter(*counter);
    const double huge = std::numeric_limits<double>::max();
    double copy_amount = huge;
    if (!passes_only) report.frame_amount = report.frame_time_ms = huge;
    for (int i = 0; i < counter->repetitions(); ++i) {
        for (int copy_again = 0; copy_again < 3; ++copy_again) { // every figure is divided by this one
            counter->start();
            copyOnce();
            copy_amount = std::min(copy_amount, counter->stop());
        }

        meter.begin();
        renderer.render(frame, size, &meter);

        if (passes_only) continue;
        const double start_ms = clockMs(CLOCK_MONOTONIC);
        counter->start();
        renderer.render(frame, size);
        report.frame_amount = std::min(*report.frame_amount, counter->stop());
        report.frame_time_ms = std::min(report.frame_time_ms, clockMs(CLOCK_MONOTONIC) - start_ms);
    }
    report.copy_per_pixel = copy_amount / area(size);
    report.passes = std::move(meter.passes);
    if (report.counter == "gpu") { // its own clock beats the wall's
        for (PassCost& pass : report.passes)
            pass.time_ms = pass.amount * 1e-6;
        if (report.frame_amount) report.frame_time_ms = *report.frame_amount * 1e-6;
    }
    return report;
}

std::string costTable(const CostReport& report) {
    const bool instructions = report.unit == "instructions";
    const std::string per_pixel = instructions ? "instr/px" : "ns/px";
    std::string text = report.rung + ", frame " + std::to_string(report.frame) + ", " +
                       std::to_string(report.size.x) + "x" + std::to_string(report.size.y) + ", " +
                       report.renderer + "\ncounted with " + report.counter +
                       (report.note.empty() ? "" : " (" + report.note + ")") + "; one copy (cu) is " +
                       fixed(report.copy_per_pixel, instructions ? 1 : 3) + " " + per_pixel + "\n\n" +
                       aligned("pass", 14, true) + aligned("size", 11) + aligned(per_pixel, 11) +
                       aligned("cu", 9) + aligned("bytes/px", 10) + aligned("ms", 9) + "\n";
    const bool timed = report.counter != "callgrind"; // under valgrind, times mean nothing
    const auto row = [&](const std::string& name, glm::ivec2 size, double amount, const std::string& bytes,
                         double time_ms) {
        text += aligned(name, 14, true) + aligned(std::to_string(size.x) + "x" + std::to_string(size.y), 11) +
                aligned(fixed(amount / area(size), instructions ? 1 : 3), 11) +
                aligned(fixed(copies(report, amount), 3), 9) + aligned(bytes, 10) +
                aligned(timed ? fixed(time_ms, 3) : "-", 9) + "\n";
    };
    double sum = 0;
    double bytes = 0;
    double time_ms = 0;
    for (const PassCost& pass : report.passes) {
        row(pass.name, pass.size, pass.amount, fixed(pass.bytes_per_pixel, 1), pass.time_ms);
        sum += pass.amount;
        bytes += pass.bytes_per_pixel * area(pass.size) / area(report.size);
        time_ms += pass.time_ms;
    }
    row("sum", report.size, sum, fixed(bytes, 1), time_ms);
    if (report.frame_amount) row("whole frame", report.size, *report.frame_amount, "", report.frame_time_ms);
    text += "\ncu: of the frame's pixels, so that the column adds up.";
    if (report.frame_amount)
        text +=
            " Whole frame: " +
            (instructions ? fixed(*report.frame_amount * 1e-6, 1) + " million instructions"
                          : fixed(*report.frame_amount * 1e-6, 3) + " ms of " + report.counter + " time") +
            ".";
    return text + "\n";
}

std::string costJson(const CostReport& report) {
    nlohmann::ordered_json json{{"rung", report.rung},
                                {"frame", report.frame},
                                {"size", {report.size.x, report.size.y}},
                                {"renderer", report.renderer},
                                {"counter", report.counter},
                                {"unit", report.unit},
                                {"copy_per_pixel", report.copy_per_pixel}};
    if (!report.note.empty()) json["note"] = report.note;
    const bool timed = report.counter != "callgrind"; // under valgrind, times mean nothing
    for (const PassCost& pass : report.passes) {
        json["passes"].push_back({{"name", pass.name},
                                  {"size", {pass.size.x, pass.size.y}},
                                  {"per_pixel", pass.amount / area(pass.size)},
                                  {"cu", copies(report, pass.amount)},
                                  {"bytes_per_pixel", pass.bytes_per_pixel},
                                  {"program", pass.program}});
        if (timed) json["passes"].back()["ms"] = pass.time_ms;
    }
    double sum = 0;
    for (const PassCost& pass : report.passes)
        sum += copies(report, pass.amount);
    json["sum_cu"] = sum;
    if (report.frame_amount) {
        json["frame_amount"] = *report.frame_amount;
        json["frame_cu"] = copies(report, *report.frame_amount);
        if (timed) json["frame_ms"] = report.frame_time_ms;
    }
    return json.dump() + "\n";
}

} // namespace gll
