/// @file
/// Elements that are smaller near faces or edges, and grow from there to the size of the body.
#pragma once

#include <vector>

namespace microslip::mesh {

class SizeField {
 public:
  /// @param element_size  of the body, in units of the model.
  explicit SizeField(double element_size) : element_size_(element_size), least_(element_size) {}

  /// @param list  "FacesList" or "CurvesList".  @param near  their tags.  @param size  there.
  void refine_at(const char* list, const std::vector<double>& near, double size);

  /// Makes it the sizes of gmsh's mesh; of all at one place the smallest counts.
  void use();

  [[nodiscard]] double least() const { return least_; }

 private:
  double element_size_;
  double least_;
  std::vector<double> fields_{};
};

}  // namespace microslip::mesh
