// How long passes take: on a GPU by its own clock, read one frame later; in software by waiting for each.
#pragma once

#include "rung/frame.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace gll {

struct PassTime {
    std::string name;
    double time_ms = 0;
};

class PassTimer final : public PassObserver {
  public:
    explicit PassTimer(bool software) : software_(software) {}
    ~PassTimer() override { glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data()); }
    PassTimer(const PassTimer&) = delete;
    PassTimer& operator=(const PassTimer&) = delete;

    // Before a frame: the times of the frame before.
    std::vector<PassTime> begin();
    void before(const std::string& pass) override;
    void after(const DrawnPass& pass) override;

  private:
    bool software_;
    bool is_timing_ = false;
    std::vector<GLuint> queries_;
    std::vector<PassTime> pending_;
    std::chrono::steady_clock::time_point start_;
};

} // namespace gll
