#include "contact/patch/mode_shape_check.hpp"

#include <stdexcept>
#include <string>

namespace microslip::contact {

void require_mode_shape(const char* owner, const char* name, const Eigen::MatrixXd& shape,
                        Eigen::Index rows, Eigen::Index columns) {
  const std::string what = std::string(owner) + ": mode shapes " + name;
  if (shape.rows() != rows || shape.cols() != columns) {
    throw std::invalid_argument(what + " are " + std::to_string(shape.rows()) + " x " +
                                std::to_string(shape.cols()) + ", expected " +
                                std::to_string(rows) + " x " + std::to_string(columns));
  }
  if (!shape.allFinite()) throw std::invalid_argument(what + " have a value that is not finite");
}

}  // namespace microslip::contact
