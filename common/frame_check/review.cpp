// A small server of one page, for one person. Whatever else runs on this machine, or in the same browser,
// must not be able to accept a frame: hence the token, and the looks at Host and Origin.
#include "frame_check/review.hpp"

#include "frame_check/bless.hpp"
#include "frame_check/report.hpp"
#include "frame_check/say.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <httplib.h>
#include <mutex>
#include <stdexcept>
#include <sys/random.h>
#include <thread>
#include <unistd.h>

namespace gll::frame_check {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* host = "127.0.0.1";
constexpr std::size_t most_bytes = 64 << 10; // of a request: a name and a reason
constexpr std::size_t workers = 8;           // browsers open connections ahead of need, and leave them idle

std::string newToken() {
    unsigned char bytes[16];
    if (getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes))
        throw std::runtime_error("this system has no random numbers for a token");
    std::string token;
    for (const unsigned char byte : bytes)
        for (const int digit : {byte >> 4, byte & 15})
            token += "0123456789abcdef"[digit];
    return token;
}

void answer(httplib::Response& response, int status, const Json& json) {
    response.status = status;
    response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

class Reviewer {
  public:
    Reviewer(std::vector<SuiteResult>& suites, const ReviewOptions& options)
        : suites_(suites), options_(options), token_(newToken()) {
        const TemporaryFolder folder;
        writeReport(folder / "report.html", options.title, suites, true);
        page_ = contents(folder / "report.html");
        const int port = server_.bind_to_any_port(host);
        if (port < 0) throw std::runtime_error(std::string(host) + ": no port can be had there");
        here_ = std::string(host) + ":" + std::to_string(port);
        serve();
    }

    std::string address() const { return "http://" + here_ + "/" + token_ + "/"; }
    std::size_t accepted() const { return accepted_.size(); }

    void run() { server_.listen_after_bind(); }
    // Stopping one that does not run yet would do nothing.
    void awaitRunning() const {
        while (!server_.is_running())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    void stop() { server_.stop(); }

  private:
    void serve() {
        server_.new_task_queue = [] { return new httplib::ThreadPool(workers); };
        server_.set_payload_max_length(most_bytes);
        server_.set_keep_alive_max_count(1); // so that nothing is left to wait for at the end
        server_.set_default_headers(
            {{"Cache-Control", "no-store"},
             {"Referrer-Policy", "no-referrer"},
             {"X-Content-Type-Options", "nosniff"},
             {"Cross-Origin-Resource-Policy", "same-origin"},
             {"Content-Security-Policy",
              "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
              "img-src data: blob:; connect-src 'self'; base-uri 'none'; form-action "
              "'none'; frame-ancestors 'none'"}});
        server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            const std::string why = refusal(request);
            const std::string why_body = why.empty() ? refusalOfBody(request) : "";
            if (why.empty() && why_body.empty()) return httplib::Server::HandlerResponse::Unhandled;
            answer(response, why.empty() ? 415 : 403, {{"error", why.empty() ? why_body : why}});
            return httplib::Server::HandlerResponse::Handled;
        });
        const std::string place = "/" + token_ + "/";
        server_.Get(place, [this](const httplib::Request&, httplib::Response& response) {
            response.set_content(page_, "text/html; charset=utf-8");
        });
        server_.Get(place + "accepted", [this](const httplib::Request&, httplib::Response& response) {
            const std::lock_guard lock(mutex_);
            answer(response, 200, accepted_);
        });
        server_.Post(place + "accept", [this](const httplib::Request& request, httplib::Response& response) {
            accept(request, response);
        });
    }

    // Why a request is none of the person's who was told the address; "" where it is.
    std::string refusal(const httplib::Request& request) const {
        // Another name for this address: a page from elsewhere whose name was made to lead here.
        if (request.get_header_value("Host") != here_) return "not by this name";
        // Browsers say the origin of whatever changes something.
        const bool is_told = request.has_header("Origin");
        if (is_told ? request.get_header_value("Origin") != "http://" + here_ : request.method != "GET")
            return "not from another page";
        if (!request.path.starts_with("/" + token_ + "/")) return "not without the token of this review";
        return "";
    }

    // Why a body is not read; "" where it is. Only of one that says its length, and is not packed, does the
    // limit hold before it is in memory.
    static std::string refusalOfBody(const httplib::Request& request) {
        if (request.has_header("Content-Encoding")) return "not packed";
        if (request.has_header("Transfer-Encoding")) return "not without its length";
        return "";
    }

    CaseResult* find(const std::string& name) {
        for (SuiteResult& suite : suites_)
            for (CaseResult& one : suite.cases)
                if (one.fullName() == name) return &one;
        return nullptr;
    }

    void accept(const httplib::Request& request, httplib::Response& response) {
        const Json wanted = Json::parse(request.body, nullptr, false);
        if (!wanted.is_object() || !wanted.contains("case") || !wanted.at("case").is_string() ||
            !wanted.contains("because") || !wanted.at("because").is_string())
            return answer(response, 400, {{"error", "wants {\"case\": NAME, \"because\": TEXT}"}});
        const std::lock_guard lock(mutex_);
        CaseResult* one = find(wanted.at("case"));
        if (one == nullptr || one->frame.empty() || one->outcome == Outcome::same)
            return answer(response, 409, {{"error", "there is no frame of that name to accept"}});
        try {
            const std::vector<Suite> suites = readSuites(one->json_file.parent_path(), options_.changes);
            std::string became =
                frame_check::accept(suites.front(), one->name, loadImage(one->frame),
                                    {.because = wanted.at("because"), .adds = options_.adds});
            became.erase(0, became.rfind('\n') + 1); // before that stands how it differs, which was looked at
            std::printf("%s: %s\n", one->fullName().c_str(), became.c_str());
            std::fflush(stdout);
            one->outcome = Outcome::same;
            for (SuiteResult& suite : suites_)
                std::erase_if(suite.problems, [&](const std::string& problem) {
                    return suite.name == one->suite && problem.starts_with(one->name + ": ");
                });
            accepted_[one->fullName()] = became;
            answer(response, 200, {{"became", became}});
        } catch (const std::exception& error) {
            answer(response, 409, {{"error", error.what()}});
        }
    }

    std::vector<SuiteResult>& suites_;
    const ReviewOptions& options_;
    std::string token_;
    std::string page_;
    std::string here_; // host and port
    httplib::Server server_;
    std::mutex mutex_; // of what follows, and of the suites: one frame is accepted after the other
    Json accepted_ = Json::object();
};

} // namespace

void review(std::vector<SuiteResult>& suites, const ReviewOptions& options) {
    requirePerson();
    const Counts counts = countsOf(suites);
    if (counts.tolerated + counts.different + counts.incomparable == 0) return;
    Reviewer reviewer(suites, options);
    // Ctrl-C is waited for here; threads begun from now on leave it alone, so that a frame that is just being
    // accepted is written whole.
    sigset_t ends{};
    sigset_t before{};
    sigemptyset(&ends);
    sigaddset(&ends, SIGINT);
    sigaddset(&ends, SIGTERM);
    sigaddset(&ends, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &ends, &before);
    std::thread server([&] { reviewer.run(); });
    reviewer.awaitRunning();
    std::printf(
        "\nLook at them and accept those that are right, in a browser on this machine:\n    %s\nCtrl-C ends "
        "the review.\n",
        reviewer.address().c_str());
    std::fflush(stdout);
    int signal = 0;
    sigwait(&ends, &signal);
    pthread_sigmask(SIG_SETMASK, &before, nullptr); // a second Ctrl-C ends it at once
    reviewer.stop();
    server.join();
    std::printf("\n%zu accepted\n", reviewer.accepted());
}

} // namespace gll::frame_check
