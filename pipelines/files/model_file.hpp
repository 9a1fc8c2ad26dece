/// @file
/// model.h5: all the response stage needs of a structure and its contact, for this program and for
/// any other that reads HDF5. Every dataset carries an attribute `unit`.
///
///   /frequency_Hz  /angular_frequency  /damping_ratio  /force_sine  /force_cosine  /force_static
///   /output                                                                    N modes each
///   /contact/points (n × 3)  weights  frame (rows p, q, r)  phi_u  phi_v  phi_w (n × N)
///   /contact/NAME                     n each: sample_arrays() of columns.hpp
///   /contact/fit_degree (1)  fit_error (N, or none)
///   /contact/vertices (m × 3)  cells (n × 3 or 4)  vertex_phi_u  vertex_phi_v  vertex_phi_w
///   /contact/vertex_NAME              m each
///
/// A second patch is in /contact_2/, a third in /contact_3/, and so on; the attributes contact,
/// contact_2, … of the file are their names then. An array the model does not have is a dataset
/// without elements.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// @throws ExhaustedError  cannot be written; nothing half-written is left.
void write_model(const std::filesystem::path& file, const ReducedModel& model);

/// The numbers of that file: equal for models of one scene that are the same, unequal for others.
[[nodiscard]] std::string arrays_of(const ReducedModel& model);

}  // namespace microslip::pipelines
