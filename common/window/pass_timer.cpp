// Timer queries, one a pass, or the wall's clock.
#include "window/pass_timer.hpp"

namespace gll {

std::vector<PassTime> PassTimer::begin() {
    if (is_timing_ && !software_) glEndQuery(GL_TIME_ELAPSED); // of a pass that could not be drawn
    is_timing_ = false;
    std::vector<PassTime> times = std::move(pending_);
    pending_.clear();
    if (!software_)
        for (std::size_t i = 0; i < times.size(); ++i) {
            GLuint64 elapsed_ns = 0;
            glGetQueryObjectui64v(queries_[i], GL_QUERY_RESULT, &elapsed_ns);
            times[i].time_ms = double(elapsed_ns) * 1e-6;
        }
    return times;
}

void PassTimer::before(const std::string&) {
    is_timing_ = true;
    if (software_) {
        glFinish();
        start_ = std::chrono::steady_clock::now();
        return;
    }
    if (pending_.size() == queries_.size()) {
        queries_.push_back(0);
        glGenQueries(1, &queries_.back());
    }
    glBeginQuery(GL_TIME_ELAPSED, queries_[pending_.size()]);
}

void PassTimer::after(const DrawnPass& pass) {
    software_ ? glFinish() : glEndQuery(GL_TIME_ELAPSED);
    is_timing_ = false;
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
    pending_.push_back({pass.name, software_ ? elapsed.count() : 0});
}

} // namespace gll
