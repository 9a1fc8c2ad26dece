/// @file
/// One owner for each PETSc or SLEPc object: moved, never copied, destroyed once.
#pragma once

#include <utility>

#include <petscsys.h>

namespace microslip::fem {

/// @tparam Type     a PETSc handle: Mat, Vec, EPS, …
/// @tparam Destroy  its XxxDestroy.
template <typename Type, PetscErrorCode (*Destroy)(Type*)>
class Handle {
 public:
  Handle() = default;
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      object_ = std::exchange(other.object_, nullptr);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  [[nodiscard]] Type get() const { return object_; }
  /// For XxxCreate(…, handle.out()): what was held before is destroyed.
  [[nodiscard]] Type* out() {
    reset();
    return &object_;
  }

 private:
  void reset() {
    if (object_ != nullptr) Destroy(&object_);  // in a destructor there is nobody to tell
    object_ = nullptr;
  }

  Type object_ = nullptr;
};

}  // namespace microslip::fem
