#include "mesh/gmsh/size_field.hpp"

#include <algorithm>

#include <gmsh.h>

namespace microslip::mesh {

namespace fields = gmsh::model::mesh::field;

void SizeField::refine_at(const char* list, const std::vector<double>& near, double size) {
  constexpr double growth = 0.5;  // of the size per length
  const int distance = fields::add("Distance");
  fields::setNumbers(distance, list, near);
  fields::setNumber(distance, "NumPointsPerCurve", 200);
  const int sizes = fields::add("Threshold");
  const double reach = std::max(0.0, element_size_ - size) / growth;
  fields::setNumber(sizes, "InField", distance);
  fields::setNumber(sizes, "SizeMin", size);
  fields::setNumber(sizes, "SizeMax", element_size_);
  fields::setNumber(sizes, "DistMin", size);
  fields::setNumber(sizes, "DistMax", size + reach);
  fields_.push_back(sizes);
  least_ = std::min(least_, size);
}

void SizeField::use() {
  if (fields_.empty()) return;
  // Else small edges would make all of their face small.
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
  const int least = fields::add("Min");
  fields::setNumbers(least, "FieldsList", fields_);
  fields::setAsBackgroundMesh(least);
}

}  // namespace microslip::mesh
