// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5/output_driver.hpp"

#include "base/write_error.hpp"

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace dust::io {
namespace {

/// The first failure of this thread; `reason` 0 = none.
struct WriteFailure {
  std::filesystem::path file;
  int reason = 0;
};
thread_local WriteFailure t_failure;

/// Under the name that the file gets when it is complete.
void note_failure(std::filesystem::path file, int reason) {
  if (t_failure.reason != 0) return;
  if (file.extension() == ".part") file.replace_extension();
  t_failure = {std::move(file), reason};
}

/// One open file. The library owns the beginning, as its C interface asks.
struct OutputFile {
  H5FD_t head{};
  std::string name;
  int descriptor = -1;
  haddr_t allocated = 0;  ///< end of what the library has allocated
  haddr_t end = 0;        ///< of the file
  bool has_failed = false;

  void fail(int reason) {
    has_failed = true;
    note_failure(name, reason);
  }
};
OutputFile& output(H5FD_t* file) { return *reinterpret_cast<OutputFile*>(file); }
const OutputFile& output(const H5FD_t* file) { return *reinterpret_cast<const OutputFile*>(file); }

H5FD_t* open_output(const char* name, unsigned, hid_t, haddr_t) {
  const int descriptor = ::open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    note_failure(name, errno);
    return nullptr;
  }
  auto file = std::make_unique<OutputFile>();
  file->name = name;
  file->descriptor = descriptor;
  return &file.release()->head;
}

herr_t close_output(H5FD_t* file) {
  const std::unique_ptr<OutputFile> out(&output(file));
  // Network file systems report a full disk here.
  if (::close(out->descriptor) != 0) out->fail(errno);
  // Half a file takes room that a full disk needs.
  if (out->has_failed) ::unlink(out->name.c_str());
  return 0;
}

herr_t query_output(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated_end(const H5FD_t* file, H5FD_mem_t) { return output(file).allocated; }
herr_t set_allocated_end(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  output(file).allocated = end;
  return 0;
}
haddr_t file_end(const H5FD_t* file, H5FD_mem_t) { return output(file).end; }

/// What was never written reads as zeros.
herr_t read_output(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) {
  OutputFile& out = output(file);
  auto* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t part = ::pread(out.descriptor, to, size, static_cast<off_t>(address));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) break;
    to += part;
    address += static_cast<haddr_t>(part);
    size -= static_cast<size_t>(part);
  }
  std::memset(to, 0, size);
  return 0;
}

herr_t write_output(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size,
                    const void* buffer) {
  OutputFile& out = output(file);
  const auto* from = static_cast<const char*>(buffer);
  out.end = std::max(out.end, address + size);
  while (size > 0 && !out.has_failed) {
    const ssize_t part = ::pwrite(out.descriptor, from, size, static_cast<off_t>(address));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) {
      out.fail(part < 0 ? errno : ENOSPC);
      break;
    }
    from += part;
    address += static_cast<haddr_t>(part);
    size -= static_cast<size_t>(part);
  }
  return 0;
}

herr_t truncate_output(H5FD_t* file, hid_t, hbool_t) {
  OutputFile& out = output(file);
  if (out.allocated == out.end || out.has_failed) return 0;
  if (::ftruncate(out.descriptor, static_cast<off_t>(out.allocated)) != 0) out.fail(errno);
  out.end = out.allocated;
  return 0;
}

hid_t register_driver() {
  static H5FD_class_t driver{};
#if H5_VERSION_GE(1, 13, 2)
  driver.version = H5FD_CLASS_VERSION;
#endif
#if H5_VERSION_GE(1, 13, 0)
  driver.value = static_cast<H5FD_class_value_t>(771);
#endif
  driver.name = "dust_output";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<std::int64_t>::max());
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.open = open_output;
  driver.close = close_output;
  driver.query = query_output;
  driver.get_eoa = allocated_end;
  driver.set_eoa = set_allocated_end;
  driver.get_eof = file_end;
  driver.read = read_output;
  driver.write = write_output;
  driver.truncate = truncate_output;
  constexpr H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kinds), std::end(kinds), std::begin(driver.fl_map));
  return H5FDregister(&driver);
}

}  // namespace

void use_output_driver(hid_t access) {
  static const hid_t driver = register_driver();
  H5Pset_driver(access, driver, nullptr);
}

void clear_write_failure() { t_failure = {}; }

void require_written() {
  if (t_failure.reason == 0) return;
  const WriteFailure failure = std::exchange(t_failure, {});
  throw base::WriteError(failure.file, failure.reason);
}

}  // namespace dust::io
