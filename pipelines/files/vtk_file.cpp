#include "pipelines/files/vtk_file.hpp"

#include <fmt/core.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include <cstddef>
#include <new>

#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

template <typename Array, typename Value, typename Matrix>
void add(vtkFieldData& data, const std::string& name, const Matrix& values) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(values.cols()));
  array->SetNumberOfTuples(values.rows());
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      array->SetTypedComponent(row, static_cast<int>(column),
                               static_cast<Value>(values(row, column)));
    }
  }
  data.AddArray(array);
}

/// Where memory ends in it the writer of VTK would follow a null pointer.
class Compressor : public vtkZLibDataCompressor {
 public:
  static Compressor* New() { VTK_STANDARD_NEW_BODY(Compressor); }

 protected:
  std::size_t CompressBuffer(const unsigned char* from, std::size_t size, unsigned char* to,
                             std::size_t space) override {
    const std::size_t used = vtkZLibDataCompressor::CompressBuffer(from, size, to, space);
    if (used == 0) throw std::bad_alloc();
    return used;
  }
};

template <typename Writer>
std::string serialise(vtkPointSet& data) {
  vtkNew<Writer> writer;
  writer->SetInputData(&data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();  // plain XML: other readers and diff tools open it too
  vtkNew<Compressor> compressor;
  compressor->SetCompressionLevel(1);  // a third of the time of 5, a tenth more bytes
  writer->SetCompressor(compressor);
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw ExhaustedError("VTK could not build a file in memory");
  return writer->GetOutputString();
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '&') {
      result += "&amp;";
    } else if (letter == '"') {
      result += "&quot;";
    } else if (letter == '<') {
      result += "&lt;";
    } else {
      result += letter;
    }
  }
  return result;
}

}  // namespace

void add_array(vtkFieldData& data, const std::string& name,
               const Eigen::Ref<const Eigen::MatrixXd>& values) {
  add<vtkDoubleArray, double>(data, name, values);
}

void add_float_array(vtkFieldData& data, const std::string& name,
                     const Eigen::Ref<const Eigen::MatrixXd>& values) {
  add<vtkFloatArray, float>(data, name, values);
}

void add_integers(vtkFieldData& data, const std::string& name,
                  const Eigen::Ref<const Eigen::VectorXi>& values) {
  add<vtkIntArray, int>(data, name, values);
}

void add_texts(vtkFieldData& data, const std::string& name,
               const std::vector<std::string>& values) {
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  for (const std::string& value : values) array->InsertNextValue(value);
  data.AddArray(array);
}

void write_vtk_file(const std::filesystem::path& file, vtkPointSet& data) {
  const bool poly_data = data.GetDataObjectType() == VTK_POLY_DATA;
  write_whole(file, poly_data ? serialise<vtkXMLPolyDataWriter>(data)
                              : serialise<vtkXMLUnstructuredGridWriter>(data));
}

void write_pvd(const std::filesystem::path& file,
               const std::vector<std::pair<double, std::string>>& steps) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const auto& [time, name] : steps) {
    text += "    <DataSet timestep=\"" + format_number(time) + "\" part=\"0\" file=\"" +
            escaped(name) + "\"/>\n";
  }
  write_whole(file, text + "  </Collection>\n</VTKFile>\n");
}

std::string step_name(const std::string& stem, int step, const std::string& extension) {
  return fmt::format("{}_{:03d}{}", stem, step, extension);
}

}  // namespace microslip::pipelines
