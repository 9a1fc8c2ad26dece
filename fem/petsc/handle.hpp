/// @file
/// Owner of one PETSc or SLEPc object: move-only, destroyed exactly once.
#pragma once

#include <utility>

#include <slepceps.h>

namespace microslip::fem {

/// @tparam Object   Mat, Vec, EPS, …: a pointer type of PETSc.
/// @tparam destroy  its destroyer, which takes the address and nulls it.
/// @note Must die before the SlepcSession does.
template <typename Object, PetscErrorCode (*destroy)(Object*)>
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

  [[nodiscard]] Object get() const { return object_; }
  explicit operator bool() const { return object_ != nullptr; }
  /// Address for a creating call; what was held before is destroyed.
  [[nodiscard]] Object* out() {
    reset();
    return &object_;
  }

 private:
  /// A destroyer fails only on a corrupted object; there is nobody to tell in a destructor.
  void reset() noexcept {
    if (object_ != nullptr) static_cast<void>(destroy(&object_));
    object_ = nullptr;
  }
  Object object_ = nullptr;
};

using MatHandle = Handle<Mat, &MatDestroy>;
using VecHandle = Handle<Vec, &VecDestroy>;
using EpsHandle = Handle<EPS, &EPSDestroy>;
using KspHandle = Handle<KSP, &KSPDestroy>;

}  // namespace microslip::fem
