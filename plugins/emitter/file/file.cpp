// SPDX-License-Identifier: Apache-2.0
#include "grain_table.hpp"
#include "hdf5_table.hpp"

#include <dust/sdk/placed_emitter.hpp>
#include <dust/sdk/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

namespace {

namespace formula = dust::model::file;
namespace sdk = dust::sdk;
using sdk::Vec3;

/// Up to so many different diameters each is a size class of its own.
constexpr std::size_t k_max_classes = 24;

bool ends_with(const std::string& text, const std::string& extension) {
  return text.size() >= extension.size() && text.ends_with(extension);
}

class File final : public sdk::PlacedEmitter {
 public:
  struct Parameters {
    std::string file;
    std::string group;
    Vec3 offset;
    bool with_velocities = true;
    std::vector<std::string> materials;
    double allowed_overlap = 0.005;
    double time = 0.0;
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.text(&Parameters::file, "file",
           "The file, seen from the scenario's folder: .csv, or .h5 or .hdf5.")
        .refers_to(sdk::Refers::file);
    s.text(&Parameters::group, "group",
           "Group of an HDF5 file; without it, the last frame of a run.")
        .optional();
    s.vector(&Parameters::offset, "offset", dim::length, "Added to all centres.").optional();
    s.boolean(&Parameters::with_velocities, "with_velocities",
              "Whether velocities and rotations of the file are taken; otherwise all are at rest.")
        .optional();
    s.texts(&Parameters::materials, "materials",
            "Materials that the file may name beside the emitter's own.")
        .refers_to(sdk::Refers::material)
        .optional();
    s.number(&Parameters::allowed_overlap, "allowed_overlap", dim::none,
             "Largest overlap at the start, of the smaller radius: a settled bed is pressed.")
        .at_least(0)
        .below(1)
        .optional();
    declare_moment(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "file",
            .version = "1.0",
            .summary = "Grains read from a file, such as a bed that has settled before.",
            .equation = "\\mathbf x_n(0) = \\mathbf x_n^{\\mathrm{file}} + \\mathbf s",
            .source = "own definition"};
  }

  explicit File(const Parameters& p) : PlacedEmitter(p.time), p_(p) {
    try {
      table_ = read();
    } catch (const formula::TableError& e) {
      throw sdk::ParameterError(e.what());
    }
    if (!p.with_velocities) {
      for (auto* columns : {&table_.velocity, &table_.rotation}) {
        for (auto& column : *columns) column.clear();
      }
    }
    find_materials();
  }

  [[nodiscard]] std::vector<double> diameters() const override {
    std::vector<double> d = table_.diameter;
    std::sort(d.begin(), d.end());
    d.erase(std::unique(d.begin(), d.end()), d.end());
    if (d.size() <= k_max_classes) return d;
    // Many sizes: classes of equal width in ln d stand for them; both ends are exact.
    const double low = d.front();
    const double high = d.back();
    std::vector<double> classes{low};
    for (std::size_t n = 1; n + 1 < k_max_classes; ++n) {
      classes.push_back(low * std::pow(high / low, static_cast<double>(n) / (k_max_classes - 1)));
    }
    classes.push_back(high);
    return classes;
  }
  [[nodiscard]] double largest_speed() const override {
    double speed = 0.0;
    for (std::size_t n = 0; n < table_.velocity[0].size(); ++n) {
      speed = std::max(speed, norm(at(table_.velocity, n)));
    }
    return speed;
  }
  [[nodiscard]] sdk::EmitterRequest request() const override {
    sdk::EmitterRequest r;
    r.begin = p_.time;
    r.count = static_cast<std::int64_t>(table_.diameter.size());
    return r;
  }
  [[nodiscard]] sdk::InsertionRule insertion_rule() const override {
    return {.waits = false, .allowed_overlap = p_.allowed_overlap};
  }
  [[nodiscard]] std::vector<std::string> materials() const override { return p_.materials; }

 protected:
  void place(const sdk::EmitterContext&, std::vector<sdk::InsertionRequest>& requests) override {
    for (std::size_t n = 0; n < table_.diameter.size(); ++n) {
      requests.push_back({.position = at(table_.centre, n) + p_.offset,
                          .velocity = at(table_.velocity, n),
                          .angular_velocity = at(table_.rotation, n),
                          .diameter = table_.diameter[n],
                          .weight = table_.weight.empty() ? 1.0 : table_.weight[n],
                          .material = material_.empty() ? -1 : material_[n],
                          .line = table_.line[n]});
    }
  }

 private:
  [[nodiscard]] formula::GrainTable read() const {
    const std::string name = p_.file.substr(p_.file.find_last_of('/') + 1);
    if (ends_with(p_.file, ".h5") || ends_with(p_.file, ".hdf5")) {
      return formula::read_hdf5(p_.file, p_.group, name);
    }
    if (!ends_with(p_.file, ".csv")) {
      throw formula::TableError(name + ": a file that ends in .csv, .h5 or .hdf5 is expected");
    }
    if (!p_.group.empty()) throw formula::TableError("group belongs to an HDF5 file; remove it");
    std::ifstream in(p_.file);
    if (!in) throw formula::TableError(name + " cannot be opened");
    return formula::read_csv(in, name);
  }

  /// A name beside those given is the emitter's own material, which it alone cannot know.
  void find_materials() {
    std::map<std::string, int> index;
    for (std::size_t n = 0; n < p_.materials.size(); ++n)
      index[p_.materials[n]] = static_cast<int>(n);
    std::string own;
    for (std::size_t n = 0; n < table_.material.size() && !p_.materials.empty(); ++n) {
      const auto known = index.find(table_.material[n]);
      material_.push_back(known == index.end() ? -1 : known->second);
      if (known != index.end()) continue;
      if (own.empty()) own = table_.material[n];
      if (own != table_.material[n]) {
        throw sdk::ParameterError("the file names the materials '" + own + "' and '" +
                                  table_.material[n] +
                                  "'; all but the emitter's own must stand in materials");
      }
    }
  }

  static Vec3 at(const std::array<std::vector<double>, 3>& columns, std::size_t n) {
    if (columns[0].empty()) return {};
    return {columns[0][n], columns[1][n], columns[2][n]};
  }

  Parameters p_;
  formula::GrainTable table_;
  std::vector<std::int32_t> material_;  ///< index into materials, -1 = the emitter's own
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<File>(); }
