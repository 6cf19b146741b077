// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5_file.hpp"

#include "base/error.hpp"
#include "io/hdf5/output_driver.hpp"
#include "io/run_files.hpp"

#include <algorithm>
#include <utility>

namespace dust::io {
namespace {

/// Pieces of a compressed dataset: large enough for few seeks, small enough for the chunk cache.
constexpr hsize_t k_chunk_bytes = 512 * 1024;
/// Deflate level 1: higher levels cost twice the time for a few per cent on float fields.
constexpr unsigned k_deflate_level = 1;

/// The innermost message of the library's error stack.
std::string library_message() {
  std::string text;
  const auto keep_first = [](unsigned, const H5E_error2_t* error, void* data) -> herr_t {
    auto& out = *static_cast<std::string*>(data);
    if (out.empty() && error->desc != nullptr) out = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  return text;
}

[[noreturn]] void fail(const std::string& what) {
  require_written();  // the system's reason, where there is one
  const std::string reason = library_message();
  throw base::RunError(what + (reason.empty() ? "" : " (" + reason + ")"));
}

void require(herr_t status, const std::string& what) {
  if (status < 0) fail(what);
}

Handle make_space(std::span<const hsize_t> extents) {
  return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose,
          "cannot describe an array"};
}

void write_numeric_attribute(hid_t object, const std::string& name, hid_t type, const void* data,
                             hsize_t count, bool is_scalar) {
  const std::string what = "cannot write attribute '" + name + "'";
  const Handle space =
      is_scalar ? Handle(H5Screate(H5S_SCALAR), H5Sclose, what) : make_space({&count, 1});
  const Handle attribute(
      H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      what);
  if (count > 0) require(H5Awrite(attribute.get(), type, data), what);
}

Handle text_type(bool is_variable, std::size_t bytes) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "cannot make a text type");
  H5Tset_size(type.get(), is_variable ? H5T_VARIABLE : std::max<std::size_t>(bytes, 1));
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

}  // namespace

Handle::Handle(hid_t id, Close closer, const std::string& what) : id_(id), close_(closer) {
  if (id < 0) fail(what);
}
Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}
Handle::~Handle() {
  if (id_ >= 0) close_(id_);
}
void Handle::close(const std::string& what) {
  if (id_ < 0) return;
  require(close_(std::exchange(id_, -1)), what);
  require_written();
}

QuietHdf5::QuietHdf5() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
QuietHdf5::~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

Handle create_file(const std::filesystem::path& file, bool with_checked_metadata) {
  const std::string what = "cannot create " + file.string();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
  use_output_driver(access.get());
  clear_write_failure();
  // By default a file with open groups stays open behind H5Fclose, unwritten, and would be renamed
  // too early; this way H5Fclose refuses.
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_SEMI);
  // Object headers and trees carry checksums from format 1.10 on.
  if (with_checked_metadata) {
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  }
  return {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose, what};
}

bool may_read_while_writing() {
  hbool_t is_safe = false;
  return H5is_library_threadsafe(&is_safe) >= 0 && is_safe;
}

void leave_hdf5_open_at_exit() { H5dont_atexit(); }

Handle open_file(const std::filesystem::path& file) {
  clear_write_failure();
  return {H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
          "cannot open " + file.string()};
}

Handle create_group(hid_t parent, const std::string& name) {
  const std::string what = "cannot create group '" + name + "'";
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  H5Pset_create_intermediate_group(links.get(), 1);
  return {H5Gcreate2(parent, name.c_str(), links.get(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose, what};
}

Handle open_group(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "no group '" + name + "'"};
}

void write_array(hid_t parent, const std::string& name, hid_t type, const void* data,
                 std::initializer_list<hsize_t> extents, Storage storage, Meaning meaning) {
  const std::string what = "cannot write '" + name + "'";
  const Handle space = make_space({extents.begin(), extents.size()});
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  H5Pset_create_intermediate_group(links.get(), 1);
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  const bool is_empty = std::find(extents.begin(), extents.end(), hsize_t{0}) != extents.end();
  if (storage != Storage::plain && !is_empty) {
    std::vector<hsize_t> chunk(extents);
    hsize_t row_bytes = H5Tget_size(type);
    for (std::size_t d = 1; d < chunk.size(); ++d) row_bytes *= chunk[d];
    chunk[0] = std::clamp<hsize_t>(k_chunk_bytes / row_bytes, 1, chunk[0]);
    H5Pset_chunk(layout.get(), static_cast<int>(chunk.size()), chunk.data());
    if (storage == Storage::compressed) {
      H5Pset_shuffle(layout.get());
      H5Pset_deflate(layout.get(), k_deflate_level);
    } else {
      H5Pset_fletcher32(layout.get());
    }
  }
  const Handle dataset(
      H5Dcreate2(parent, name.c_str(), type, space.get(), links.get(), layout.get(), H5P_DEFAULT),
      H5Dclose, what);
  if (!is_empty) {
    require(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), what);
  }
  write_attribute(dataset.get(), "units", std::string(meaning.units));
  write_attribute(dataset.get(), "long_name", std::string(meaning.long_name));
  require_written();
}

std::vector<hsize_t> extents_of(hid_t parent, const std::string& name) {
  const std::string what = "no dataset '" + name + "'";
  const Handle dataset(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, what);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose, what);
  std::vector<hsize_t> extents(
      static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space.get()), 0)));
  require(H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr), what);
  return extents;
}

void read_array(hid_t parent, const std::string& name, hid_t type, void* data) {
  const std::string what = "cannot read '" + name + "'";
  const Handle dataset(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, what);
  require(H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), what);
}

void write_attribute(hid_t object, const std::string& name, double value) {
  write_numeric_attribute(object, name, H5T_NATIVE_DOUBLE, &value, 1, true);
}
void write_attribute(hid_t object, const std::string& name, std::int64_t value) {
  write_numeric_attribute(object, name, H5T_NATIVE_INT64, &value, 1, true);
}
void write_attribute(hid_t object, const std::string& name, std::span<const double> values) {
  write_numeric_attribute(object, name, H5T_NATIVE_DOUBLE, values.data(), values.size(), false);
}
void write_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> values) {
  write_numeric_attribute(object, name, H5T_NATIVE_INT64, values.data(), values.size(), false);
}
void write_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Handle type = text_type(false, value.size() + 1);
  write_numeric_attribute(object, name, type.get(), value.c_str(), 1, true);
}
void write_attribute(hid_t object, const std::string& name,
                     const std::vector<std::string>& values) {
  const Handle type = text_type(true, 0);
  std::vector<const char*> pointers;
  pointers.reserve(values.size());
  for (const std::string& value : values) pointers.push_back(value.c_str());
  write_numeric_attribute(object, name, type.get(), pointers.data(), pointers.size(), false);
}

std::vector<double> read_attribute(hid_t object, const std::string& name) {
  const std::string what = "no attribute '" + name + "'";
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, what);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose, what);
  std::vector<double> values(
      static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.get()), 0)));
  require(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, values.data()), what);
  return values;
}

}  // namespace dust::io
