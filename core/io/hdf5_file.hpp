// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace dust::io {

/// An open HDF5 object; closed by the destructor. Errors are reported where objects are made.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  /// Throws base::RunError with `what` when `id` is an error.
  Handle(hid_t id, Close closer, const std::string& what);
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle();
  [[nodiscard]] hid_t get() const { return id_; }
  /// Closes now and throws when that fails: the last writes of a file may fail here.
  void close(const std::string& what);

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Silences the library's printing of its own error stack while it lives; the library is asked for
/// its message instead. The stack belongs to the thread.
class QuietHdf5 {
 public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// How a dataset lies in its file.
enum class Storage { plain, compressed, checked };

/// What a reader must know of a dataset; both become attributes.
struct Meaning {
  const char* units;
  const char* long_name;
};

Handle create_file(const std::filesystem::path& file, bool with_checked_metadata = false);
Handle open_file(const std::filesystem::path& file);
Handle create_group(hid_t parent, const std::string& name);
Handle open_group(hid_t parent, const std::string& name);

/// Writes `data` of the native type `type` as dataset `name` with the given extents; extents of 0
/// are allowed. `compressed` cuts it into pieces along the first extent, shuffles bytes and
/// deflates; `checked` adds a checksum (fletcher32), so that a damaged file is noticed when it is
/// read.
void write_array(hid_t parent, const std::string& name, hid_t type, const void* data,
                 std::initializer_list<hsize_t> extents, Storage storage, Meaning meaning);

/// Extents of dataset `name`.
std::vector<hsize_t> extents_of(hid_t parent, const std::string& name);
void read_array(hid_t parent, const std::string& name, hid_t type, void* data);

void write_attribute(hid_t object, const std::string& name, double value);
void write_attribute(hid_t object, const std::string& name, std::int64_t value);
void write_attribute(hid_t object, const std::string& name, const std::string& value);
void write_attribute(hid_t object, const std::string& name, std::span<const double> values);
void write_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> values);
/// An array of strings of variable length; nothing is written for an empty list but an empty array.
void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& values);
std::vector<double> read_attribute(hid_t object, const std::string& name);

}  // namespace dust::io
