#pragma once

#include <utility>

namespace prt {

/// A name that OpenGL has given to an object, given back when this goes; the context must be
/// current then.
class GlName {
  public:
    GlName() = default;
    /// @param release  gives the name back; never called for 0
    GlName(unsigned name, void (*release)(unsigned name)) : name_(name), release_(release) {}
    ~GlName() {
        if (name_ != 0) release_(name_);
    }
    GlName(GlName&& other) noexcept
        : name_(std::exchange(other.name_, 0u)), release_(other.release_) {}
    GlName& operator=(GlName&& other) noexcept {
        std::swap(name_, other.name_);
        std::swap(release_, other.release_);
        return *this;
    }

    unsigned get() const { return name_; }

  private:
    unsigned name_ = 0;
    void (*release_)(unsigned name) = nullptr;
};

}  // namespace prt
