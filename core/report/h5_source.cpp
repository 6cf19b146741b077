// SPDX-License-Identifier: Apache-2.0
#include "report/h5_source.hpp"

#include <hdf5.h>

#include <algorithm>
#include <type_traits>

namespace dust::report {

static_assert(std::is_same_v<H5E_auto2_t, int (*)(hid_t, void*)>);
static_assert(sizeof(hid_t) == sizeof(std::int64_t));

namespace {

/// A handle with the function that gives it back.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: a handle is its number

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Below zero where there is none.
Handle attribute_of(hid_t file, const std::string& object, const std::string& name) {
  const Handle node(file < 0 ? -1 : H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
  return {node < 0 ? -1 : H5Aopen(node, name.c_str(), H5P_DEFAULT), H5Aclose};
}

std::vector<hsize_t> extents(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank <= 0) return {};
  std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return sizes;
}

template <typename T>
std::vector<T> read_all(hid_t file, const std::string& name, hid_t type) {
  const Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) return {};
  const Handle space(H5Dget_space(set), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count <= 0) return {};
  std::vector<T> values(static_cast<std::size_t>(count));
  if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) return {};
  return values;
}

}  // namespace

H5Source::H5Source(const std::filesystem::path& file) {
  H5Eget_auto2(H5E_DEFAULT, &old_handler_, &old_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (!std::filesystem::is_regular_file(file)) return;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);  // reading beside a run that goes on is harmless
  file_ = H5Fopen(file.c_str(), H5F_ACC_RDONLY, access);
}

H5Source::~H5Source() {
  if (file_ >= 0) H5Fclose(file_);
  H5Eset_auto2(H5E_DEFAULT, old_handler_, old_data_);
}

std::vector<std::string> H5Source::frames(const std::string& group) const {
  std::vector<std::string> names = members(group);
  std::erase_if(names, [&](const std::string& name) {
    const bool is_number =
        std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
    return !is_number ||
           Handle(H5Gopen2(file_, (group + "/" + name).c_str(), H5P_DEFAULT), H5Gclose) < 0;
  });
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return names;
}

std::size_t H5Source::missing_frames(const std::string& group) const {
  if (!is_open()) return 0;
  const Handle node(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (node < 0 || H5Gget_info(node, &info) < 0) return 0;
  return static_cast<std::size_t>(info.nlinks) -
         std::min<std::size_t>(info.nlinks, frames(group).size());
}

std::vector<double> H5Source::attribute(const std::string& object, const std::string& name) const {
  const Handle attribute = attribute_of(file_, object, name);
  if (attribute < 0) return {};
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count <= 0) return {};
  std::vector<double> values(static_cast<std::size_t>(count));
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0) return {};
  return values;
}

std::vector<std::string> H5Source::texts(const std::string& object, const std::string& name) const {
  const Handle attribute = attribute_of(file_, object, name);
  if (attribute < 0) return {};
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const Handle given(H5Aget_type(attribute), H5Tclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count <= 0 || H5Tget_class(given) != H5T_STRING || H5Tis_variable_str(given) <= 0) return {};
  std::vector<char*> found(static_cast<std::size_t>(count), nullptr);
  if (H5Aread(attribute, given, found.data()) < 0) return {};
  std::vector<std::string> list;
  list.reserve(found.size());
  for (const char* text : found) list.emplace_back(text == nullptr ? "" : text);
  H5Dvlen_reclaim(given, space, H5P_DEFAULT, found.data());
  return list;
}

std::string H5Source::text(const std::string& object, const std::string& name) const {
  const Handle attribute = attribute_of(file_, object, name);
  if (attribute < 0) return {};
  const Handle given(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(given) != H5T_STRING || H5Tis_variable_str(given) != 0) return {};
  std::string found(H5Tget_size(given), '\0');
  if (H5Aread(attribute, given, found.data()) < 0) return {};
  return found.substr(0, found.find('\0'));
}

std::vector<std::string> H5Source::members(const std::string& group) const {
  if (!is_open()) return {};
  const Handle node(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (node < 0 || H5Gget_info(node, &info) < 0) return {};
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    const auto length =
        H5Lget_name_by_idx(node, ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT);
    if (length <= 0) continue;
    std::string& name = names.emplace_back(static_cast<std::size_t>(length), '\0');
    H5Lget_name_by_idx(node, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size() + 1,
                       H5P_DEFAULT);
  }
  return names;
}

std::vector<std::size_t> H5Source::shape(const std::string& dataset) const {
  if (!is_open()) return {};
  const Handle set(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) return {};
  const Handle space(H5Dget_space(set), H5Sclose);
  const auto sizes = extents(space);
  return {sizes.begin(), sizes.end()};
}

std::vector<float> H5Source::floats(const std::string& dataset) const {
  return is_open() ? read_all<float>(file_, dataset, H5T_NATIVE_FLOAT) : std::vector<float>{};
}

std::vector<std::int64_t> H5Source::integers(const std::string& dataset) const {
  return is_open() ? read_all<std::int64_t>(file_, dataset, H5T_NATIVE_INT64)
                   : std::vector<std::int64_t>{};
}

std::vector<float> H5Source::plane(const std::string& dataset, std::size_t row) const {
  if (!is_open()) return {};
  const Handle set(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) return {};
  const Handle space(H5Dget_space(set), H5Sclose);
  auto count = extents(space);
  if (count.size() < 3 || row >= count[1]) return {};
  std::vector<hsize_t> start(count.size(), 0);
  start[1] = row;
  count[1] = 1;
  std::size_t total = 1;
  for (const hsize_t n : count) total *= static_cast<std::size_t>(n);
  if (total == 0) return {};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                      H5Sclose);
  std::vector<float> values(total);
  if (H5Dread(set, H5T_NATIVE_FLOAT, memory, space, H5P_DEFAULT, values.data()) < 0) return {};
  return values;
}

std::vector<std::size_t> spread_frames(std::size_t written, std::size_t most) {
  std::vector<std::size_t> kept;
  if (written == 0 || most == 0) return kept;
  const std::size_t stride = (written + most - 1) / most;
  for (std::size_t k = (written - 1) % stride; k < written; k += stride) kept.push_back(k);
  return kept;
}

}  // namespace dust::report
