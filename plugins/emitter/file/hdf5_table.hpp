// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "grain_table.hpp"

#include <hdf5.h>

#include <string>
#include <utility>
#include <vector>

namespace dust::model::file {
namespace detail {

/// An open HDF5 object.
class Object {
 public:
  Object(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Switches off the library's own printing of errors.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

inline bool has(hid_t group, const std::string& name) {
  return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0;
}

/// A dataset of `width` numbers a row, row by row.
inline std::vector<double> read(hid_t group, const std::string& name, hsize_t width,
                                const std::string& place) {
  const Object set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.is_open()) throw TableError(place + "the dataset '" + name + "' is missing");
  const Object space(H5Dget_space(set.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> extents(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
  const bool fits = width == 1 ? rank == 1 : rank == 2 && extents[1] == width;
  if (!fits) {
    throw TableError(place + "the dataset '" + name + "' must have " +
                     (width == 1 ? std::string("one number") : std::to_string(width) + " numbers") +
                     " per grain");
  }
  std::vector<double> values(static_cast<std::size_t>(extents[0] * width));
  if (H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    throw TableError(place + "the dataset '" + name + "' cannot be read as numbers");
  }
  return values;
}

/// The last of the groups whose names are numbers: the last frame of a run.
inline std::string last_frame(hid_t parent) {
  H5G_info_t info{};
  if (H5Gget_info(parent, &info) < 0 || info.nlinks == 0) return {};
  char name[256] = {};
  H5Lget_name_by_idx(parent, ".", H5_INDEX_NAME, H5_ITER_INC, info.nlinks - 1, name, sizeof name,
                     H5P_DEFAULT);
  return name;
}

/// The root attribute `material_names` of a results file.
inline std::vector<std::string> material_names(hid_t file) {
  std::vector<std::string> names;
  if (H5Aexists(file, "material_names") <= 0) return names;
  const Object attribute(H5Aopen(file, "material_names", H5P_DEFAULT), H5Aclose);
  const Object space(H5Aget_space(attribute.get()), H5Sclose);
  const Object type(H5Aget_type(attribute.get()), H5Tclose);
  const auto count = H5Sget_simple_extent_npoints(space.get());
  if (count <= 0 || H5Tis_variable_str(type.get()) <= 0) return names;
  std::vector<char*> texts(static_cast<std::size_t>(count), nullptr);
  if (H5Aread(attribute.get(), type.get(), texts.data()) < 0) return names;
  for (const char* text : texts) names.emplace_back(text != nullptr ? text : "");
  H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, texts.data());
  return names;
}

inline void spread(const std::vector<double>& rows, std::array<std::vector<double>, 3>& columns) {
  for (std::size_t d = 0; d < 3; ++d) {
    columns[d].resize(rows.size() / 3);
    for (std::size_t n = 0; n < columns[d].size(); ++n) columns[d][n] = rows[3 * n + d];
  }
}

}  // namespace detail

/// Reads grains from a group of an HDF5 file: the datasets `diameter` (n) and `position` (n x 3),
/// and where they are there `velocity`, `angular_velocity` (n x 3), `weight` (n, real grains for
/// each) and `material` (n, index into the root attribute `material_names`). That is how a run's
/// results.h5 keeps a frame; without `group` the last frame is taken, or the root where there are
/// no frames. Throws TableError.
inline GrainTable read_hdf5(const std::string& path, std::string group, const std::string& name) {
  using detail::Object;
  const detail::Quiet quiet;
  const Object file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.is_open()) throw TableError(name + " is not an HDF5 file that can be read");
  if (group.empty() && detail::has(file.get(), "particles")) {
    const Object frames(H5Gopen2(file.get(), "particles", H5P_DEFAULT), H5Gclose);
    group = "particles";
    if (!detail::has(frames.get(), "position")) group += "/" + detail::last_frame(frames.get());
  }
  const std::string place = name + ":/" + group + ": ";
  const Object from(H5Gopen2(file.get(), group.empty() ? "/" : group.c_str(), H5P_DEFAULT),
                    H5Gclose);
  if (!from.is_open()) throw TableError(place + "there is no such group");
  GrainTable table;
  table.diameter = detail::read(from.get(), "diameter", 1, place);
  detail::spread(detail::read(from.get(), "position", 3, place), table.centre);
  if (detail::has(from.get(), "velocity")) {
    detail::spread(detail::read(from.get(), "velocity", 3, place), table.velocity);
  }
  if (detail::has(from.get(), "angular_velocity")) {
    detail::spread(detail::read(from.get(), "angular_velocity", 3, place), table.rotation);
  }
  if (detail::has(from.get(), "weight")) {
    table.weight = detail::read(from.get(), "weight", 1, place);
  }
  const auto names = detail::material_names(file.get());
  if (!names.empty() && detail::has(from.get(), "material")) {
    for (const double m : detail::read(from.get(), "material", 1, place)) {
      const auto index = static_cast<std::size_t>(m);
      table.material.push_back(m >= 0.0 && index < names.size() ? names[index] : std::string());
    }
  }
  const std::size_t count = table.diameter.size();
  for (std::size_t n = 0; n < count; ++n) {
    bool is_good = n < table.centre[0].size() && table.diameter[n] > 0.0;
    for (std::size_t d = 0; d < 3 && is_good; ++d) is_good = std::isfinite(table.centre[d][n]);
    if (!is_good) {
      throw TableError(place + "row " + std::to_string(n) +
                       ": a diameter above 0 and a centre are expected");
    }
  }
  for (const auto* columns : {&table.centre, &table.velocity, &table.rotation}) {
    if (!(*columns)[0].empty() && (*columns)[0].size() != count) {
      throw TableError(place + "the datasets differ in length");
    }
  }
  if ((!table.material.empty() && table.material.size() != count) ||
      (!table.weight.empty() && table.weight.size() != count)) {
    throw TableError(place + "the datasets differ in length");
  }
  for (std::size_t n = 0; n < table.weight.size(); ++n) {
    if (table.weight[n] > 0.0 && std::isfinite(table.weight[n])) continue;
    throw TableError(place + "row " + std::to_string(n) + ": a weight above 0 is expected");
  }
  if (count == 0) throw TableError(place + "no grains");
  table.line.assign(count, 0);
  return table;
}

}  // namespace dust::model::file
