// SPDX-License-Identifier: Apache-2.0
#include "report/page.hpp"

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "report/assets.hpp"
#include "report/blob.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>

namespace dust::report {

namespace {

namespace fs = std::filesystem;

/// Everything outside ASCII is written as \uXXXX, so only '<' is left to guard.
std::string script_json(const nlohmann::json& value) {
  const std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

/// A file of `folder`, or one that travels inside the library.
std::optional<std::string> read(const fs::path& folder, const std::string& name) {
  if (!folder.empty()) {
    std::ifstream stream(folder / name, std::ios::binary);
    if (stream) return std::string(std::istreambuf_iterator<char>(stream), {});
  }
  const std::string_view inside = report_asset(name);
  if (inside.data() == nullptr) return std::nullopt;
  return std::string(inside);
}

std::string data_uri(const std::string& name, const std::string& bytes) {
  const bool is_svg = name.ends_with(".svg");
  return std::string("data:image/") + (is_svg ? "svg+xml" : "png") + ";base64," +
         base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

/// Fills the places of a template; files may have places themselves.
class Filling {
 public:
  Filling(const Templates& templates, const nlohmann::json& data)
      : templates_(templates), data_(data) {}

  void append(std::string& page, const std::string& text, int depth = 0) const {
    constexpr int k_deepest = 8;  // a file that includes itself ends there
    std::size_t from = 0;
    for (auto at = text.find("{{"); at != std::string::npos; at = text.find("{{", from)) {
      const auto end = text.find("}}", at);
      if (end == std::string::npos) break;
      page.append(text, from, at - from);
      const std::string place = text.substr(at + 2, end - at - 2);
      from = end + 2;
      if (place.starts_with("file:") && depth < k_deepest) {
        append(page, templates_.text(place.substr(5)), depth + 1);
      } else if (place.starts_with("packed:")) {
        const std::string whole = templates_.text(place.substr(7));
        page += packed({reinterpret_cast<const std::uint8_t*>(whole.data()), whole.size()});
      } else if (place.starts_with("image:")) {
        page += image(place.substr(6));
      } else if (place == "data") {
        page += script_json(data_);
      } else if (place == "version") {
        page += DUST_VERSION;
      } else {
        page += "{{";  // no place of ours
        from = at + 2;
      }
    }
    page.append(text, from);
  }

 private:
  [[nodiscard]] std::string image(const std::string& name) const {
    if (name != "logo") return data_uri(name, templates_.text(name));
    return templates_.has("logo.png") ? data_uri("logo.png", templates_.text("logo.png"))
                                      : data_uri("logo.svg", templates_.text("logo.svg"));
  }

  const Templates& templates_;
  const nlohmann::json& data_;
};

}  // namespace

Templates::Templates(const fs::path& own) : own_(own) {
  const char* const named = std::getenv("DUST_REPORT_TEMPLATE");
  if (own_.empty() && named != nullptr) own_ = named;
  if (!own_.empty() && !fs::is_directory(own_)) {
    throw base::UserError("error: " + own_.string() +
                          " is no folder with templates; copy share/dust/report and change it");
  }
}

bool Templates::has(const std::string& name) const { return read(own_, name).has_value(); }

std::string Templates::text(const std::string& name) const {
  const auto found = read(own_, name);
  if (!found) {
    throw base::UserError("error: the page needs the file '" + name + "', which is neither in " +
                          (own_.empty() ? std::string("the engine") : own_.string()) +
                          " nor one of the engine's own; put it there or take its name out of the "
                          "template");
  }
  return *found;
}

std::string page_of(const Templates& templates, const std::string& name,
                    const nlohmann::json& data) {
  std::string page;
  Filling(templates, data).append(page, templates.text(name));
  return page;
}

void write_page(const fs::path& target, const std::string& text) { io::write_text(target, text); }

}  // namespace dust::report
