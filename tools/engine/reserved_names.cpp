// SPDX-License-Identifier: Apache-2.0
#include "reserved_names.hpp"

#include <map>
#include <sstream>

namespace dust::engine {
namespace {

struct Reserved {
  const char* why;
  const char* names;
};

/// All in snake_case: other names are refused for that.
constexpr Reserved k_reserved[] = {
    {"a keyword of C++",
     "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t "
     "char32_t class compl concept const consteval constexpr constinit const_cast continue "
     "co_await "
     "co_return co_yield decltype default delete do double dynamic_cast else enum explicit export "
     "extern false final float for friend goto if import inline int long module mutable namespace "
     "new noexcept not not_eq nullptr operator or or_eq override private protected public register "
     "reinterpret_cast requires return short signed sizeof static static_assert static_cast struct "
     "switch template this thread_local throw true try typedef typeid typename union unsigned "
     "using "
     "virtual void volatile wchar_t while xor xor_eq"},
    {"a name that g++ defines", "linux unix"},
    {"a name of the sources a plugin is made of", "dust formula main sdk std"},
    {"a target that CMake makes itself",
     "all build_test clean default_target depend edit_cache  help install "
     "package package_source preinstall rebuild_cache test uninstall"},
    {"a function or type of the C library",
     "abort abs access acos acosh asin asinh assert atan atan2 atanh atexit atof atoi atol bind "
     "brk calloc cbrt ceil clock clone close connect copysign cos cosh ctime daemon difftime div "
     "drem dup erf erfc errno exit exp exp10 exp2 expm1 fabs fdim ffs floor fma fmax fmin fmod "
     "fork "
     "free frexp gamma getenv gmtime hypot ilogb index j0 j1 jn labs ldexp ldiv lgamma link listen "
     "llabs lldiv llrint llround localtime log log10 log1p log2 logb lrint lround malloc mktime "
     "modf nan nearbyint nextafter nice open pause pipe pow printf putenv puts qsort raise rand "
     "random read realloc recv remainder remove rename rindex rint round scalb select send signal "
     "signgam significand sin sincos sinh sleep socket sqrt srand stat stderr stdin stdout strtod "
     "sync system tan tanh tgamma time timezone trunc wait write y0 y1 yn"}};

std::map<std::string, std::string> table() {
  std::map<std::string, std::string> all;
  for (const Reserved& reserved : k_reserved) {
    std::istringstream names(reserved.names);
    for (std::string name; names >> name;) all.emplace(name, reserved.why);
  }
  return all;
}

}  // namespace

std::string why_reserved(const std::string& name) {
  static const auto all = table();
  const auto found = all.find(name);
  if (found != all.end()) return found->second;
  // Two underscores in a row are the compiler's own.
  return name.find("__") != std::string::npos
             ? "with two underscores in a row one of the compiler's own"
             : "";
}

}  // namespace dust::engine
