// SPDX-License-Identifier: Apache-2.0
// Loaded into the engine before the C library (LD_PRELOAD): writes down which files it waits for on
// the disk and which it renames, in this order, into the file that $SYNC_LOG names.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

void note(const std::string& line) {
  const char* file = std::getenv("SYNC_LOG");
  if (file == nullptr) return;
  const int log = ::open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (log < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(log, line.data(), line.size());
  ::close(log);
}

std::string path_of(int descriptor) {
  char path[PATH_MAX];
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = ::readlink(link.c_str(), path, sizeof path);
  return length < 0 ? std::string() : std::string(path, static_cast<std::size_t>(length));
}

}  // namespace

extern "C" int fsync(int descriptor) {
  static const auto real = reinterpret_cast<int (*)(int)>(::dlsym(RTLD_NEXT, "fsync"));
  note("sync\t" + path_of(descriptor) + "\n");
  return real(descriptor);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  static const auto real =
      reinterpret_cast<int (*)(const char*, const char*)>(::dlsym(RTLD_NEXT, "rename"));
  note("rename\t" + std::string(to) + "\n");
  return real(from, to);
}
