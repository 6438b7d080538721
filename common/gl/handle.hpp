// The owner of one OpenGL object name: moves, never copies, deletes the object when it goes.
#pragma once

#include <glad/gl.h>
#include <utility>

namespace gll {

// Delete is the function that deletes one object by name; 0 is "no object". The context that made the object
// must be current when the handle goes.
template <void (*Delete)(GLuint)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Handle() {
        if (id_ != 0) Delete(id_);
    }

    GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

} // namespace gll
