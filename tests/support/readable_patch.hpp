/// @file
/// A patch force that tells its points and mode shapes again:
/// for tests that make another contact of a scene's.
#pragma once

#include <utility>

#include "contact/force/patch_force.hpp"

namespace microslip::tests {

class ReadablePatch : public contact::PatchForce {
 public:
  ReadablePatch(contact::ContactPatch patch, contact::ModalShapes shapes)
      : PatchForce(patch, std::move(shapes)), patch_(std::move(patch)) {}

  [[nodiscard]] const contact::ContactPatch& patch() const { return patch_; }
  using PatchForce::shapes;

 private:
  contact::ContactPatch patch_;
};

}  // namespace microslip::tests
