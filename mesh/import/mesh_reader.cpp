#include "mesh/mesh_reader.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "mesh/import/gmsh_elements.hpp"
#include "mesh/import/gmsh_source.hpp"

namespace microslip::mesh {
namespace {

static_assert(std::endian::native == std::endian::little, "binary files are read as they lie");

/// Reads the sections of one file; formats 2.2 and 4.1 differ in how the numbers are laid out.
class Reader {
 public:
  explicit Reader(GmshSource source) : source_(std::move(source)) {}

  GmshContent read() {
    std::string first = source_.next_section();
    while (first == "Comments") first = source_.next_section();
    if (first != "MeshFormat") source_.fail("not a gmsh mesh: no $MeshFormat");
    read_format();
    bool nodes = false;
    bool elements = false;
    for (std::string name = source_.next_section(); !name.empty(); name = source_.next_section()) {
      if (name == "PhysicalNames") read_names();
      if (name == "Entities" && version_4_) read_entities();
      if (name == "PartitionedEntities") source_.fail("partitioned meshes are not read");
      if (name == "Nodes") {
        version_4_ ? read_nodes_4() : read_nodes_2();
        source_.expect_end(name);
        nodes = true;
      }
      if (name == "Elements") {
        version_4_ ? read_elements_4() : read_elements_2();
        source_.expect_end(name);
        elements = true;
      }
    }
    if (!nodes || !elements) {
      source_.fail(nodes ? "section $Elements is missing" : "section $Nodes is missing");
    }
    return std::move(content_);
  }

 private:
  void read_format() {
    const double version = source_.real();
    if (version != 2.2 && version != 4.1) {
      source_.fail("format " + std::to_string(version).substr(0, 3) +
                   " is not read; save as 4.1 or 2.2");
    }
    version_4_ = version == 4.1;
    const std::int64_t kind = source_.integer();
    const std::int64_t word = source_.integer();
    if (kind != 0 && kind != 1) source_.fail("the file type must be 0 (text) or 1 (binary)");
    if (word != 8) source_.fail("numbers of " + std::to_string(word) + " bytes are not read");
    source_.end_line();
    if (kind == 0) return;
    source_.set_binary(true);
    if (source_.integer() != 1) source_.fail("the file was written with the other byte order");
  }

  /// Always text, in binary files as well.
  void read_names() {
    const bool binary = source_.binary();
    source_.set_binary(false);
    const std::int64_t n = source_.count(false, 5);
    source_.end_line();
    for (std::int64_t i = 0; i < n; ++i) {
      const auto dimension = static_cast<int>(source_.integer());
      const std::int64_t tag = source_.integer();
      const std::string_view rest = source_.line();
      if (rest.size() < 2 || rest.front() != '"' || rest.back() != '"') {
        source_.fail("expected a name in quotes");
      }
      add_name(dimension, tag, std::string(rest.substr(1, rest.size() - 2)));
    }
    source_.set_binary(binary);
  }

  /// Groups of one name would be one surface or set. Those of volumes name nothing here.
  void add_name(int dimension, std::int64_t tag, const std::string& name) {
    const auto [same, is_new] = group_of_name_.try_emplace({dimension, name}, tag);
    if (!is_new && same->second != tag && dimension < 3) {
      source_.fail("physical groups " + std::to_string(same->second) + " and " +
                   std::to_string(tag) + " of dimension " + std::to_string(dimension) +
                   " are both named \"" + name + "\"; rename one, or make one group of them");
    }
    content_.group_names[{dimension, tag}] = name;
  }

  void read_entities() {
    std::array<std::int64_t, 4> counts{};
    for (std::int64_t& n : counts) n = source_.count(true, 4);
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
        const std::int64_t tag = source_.integer();
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) static_cast<void>(source_.real());
        auto& groups = groups_[{dimension, tag}];
        const std::int64_t n_groups = source_.count(true, 2);
        // A negative number means the group holds the entity reversed.
        for (std::int64_t k = 0; k < n_groups; ++k) groups.push_back(std::abs(source_.integer()));
        if (dimension == 0) continue;
        const std::int64_t n_bounding = source_.count(true, 2);
        for (std::int64_t k = 0; k < n_bounding; ++k) static_cast<void>(source_.integer());
      }
    }
  }

  void add_node(std::int64_t tag) { content_.node_tags.push_back(tag); }
  void add_position() {
    for (int d = 0; d < 3; ++d) content_.coordinates.push_back(source_.real());
  }

  void read_nodes_2() {
    const std::int64_t n = count_on_line(7);
    for (std::int64_t i = 0; i < n; ++i) {
      add_node(source_.integer());
      add_position();
    }
  }

  void read_nodes_4() {
    const std::int64_t n_blocks = source_.count(true, 7);
    for (int i = 0; i < 3; ++i) static_cast<void>(source_.size(true));
    for (std::int64_t b = 0; b < n_blocks; ++b) {
      const std::int64_t dimension = source_.integer();
      static_cast<void>(source_.integer());
      const std::int64_t parametric = source_.integer();
      const std::int64_t n = source_.count(true, 7);
      for (std::int64_t i = 0; i < n; ++i) add_node(source_.size(true));
      for (std::int64_t i = 0; i < n; ++i) {
        add_position();
        const std::int64_t n_parameters = parametric != 0 ? dimension : 0;
        for (std::int64_t k = 0; k < n_parameters; ++k) static_cast<void>(source_.real());
      }
    }
  }

  /// In format 2.2 the count is text, even in binary files.
  std::int64_t count_on_line(std::int64_t least_bytes) {
    const bool binary = source_.binary();
    source_.set_binary(false);
    const std::int64_t n = source_.count(false, least_bytes);
    source_.end_line();
    source_.set_binary(binary);
    return n;
  }

  const GmshType& type_of(std::int64_t number) {
    const GmshType* type = gmsh_type(number);
    if (type == nullptr) {
      source_.fail("element type " + std::to_string(number) + ": " + gmsh_remedy(type));
    }
    if (type->dimension == 3 && !type->supported) {
      source_.fail(std::string(type->name) + " elements: " + gmsh_remedy(type));
    }
    return *type;
  }

  void read_elements_2() {
    const std::int64_t n = count_on_line(4);
    for (std::int64_t i = 0; i < n;) {
      if (source_.binary()) {
        const GmshType& type = type_of(source_.integer());
        const std::int64_t n_of_type = source_.count(false, 4);
        const std::int64_t n_tags = source_.count(false, 0);
        for (std::int64_t k = 0; k < n_of_type; ++k) {
          add_element_2(type, source_.integer(), n_tags);
        }
        i += std::max<std::int64_t>(n_of_type, 1);
      } else {
        const std::int64_t tag = source_.integer();
        const GmshType& type = type_of(source_.integer());
        add_element_2(type, tag, source_.count(false, 1));
        ++i;
      }
    }
  }

  void add_element_2(const GmshType& type, std::int64_t tag, std::int64_t n_tags) {
    GmshElement element;
    element.type = type.number;
    element.tag = tag;
    for (std::int64_t k = 0; k < n_tags; ++k) {
      const std::int64_t value = source_.integer();
      if (k == 0 && value != 0) element.groups.push_back(std::abs(value));
    }
    for (int k = 0; k < type.n_nodes; ++k) element.nodes.push_back(source_.integer());
    content_.elements.push_back(std::move(element));
  }

  void read_elements_4() {
    const std::int64_t n_blocks = source_.count(true, 5);
    for (int i = 0; i < 3; ++i) static_cast<void>(source_.size(true));
    for (std::int64_t b = 0; b < n_blocks; ++b) {
      const auto dimension = static_cast<int>(source_.integer());
      const std::int64_t entity = source_.integer();
      const GmshType& type = type_of(source_.integer());
      const std::int64_t n = source_.count(true, 2);
      const auto groups = groups_.find({dimension, entity});
      for (std::int64_t i = 0; i < n; ++i) {
        GmshElement element;
        element.type = type.number;
        element.tag = source_.size(true);
        if (groups != groups_.end()) element.groups = groups->second;
        for (int k = 0; k < type.n_nodes; ++k) element.nodes.push_back(source_.size(true));
        content_.elements.push_back(std::move(element));
      }
    }
  }

  GmshSource source_;
  GmshContent content_;
  bool version_4_ = false;
  std::map<std::pair<int, std::string>, std::int64_t> group_of_name_;
  std::map<std::pair<int, std::int64_t>, std::vector<std::int64_t>> groups_;  // of an entity
};

}  // namespace

Mesh read_gmsh(const std::filesystem::path& file, double length_unit, const std::string& name,
               Joined joined) {
  if (!(length_unit > 0.0) || !std::isfinite(length_unit)) {
    throw std::invalid_argument("length unit " + std::to_string(length_unit) + "; must be above 0");
  }
  const std::string called = name.empty() ? file.string() : name;
  return make_mesh(Reader(GmshSource(file, called)).read(), length_unit, called, joined);
}

}  // namespace microslip::mesh
