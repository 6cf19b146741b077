// SPDX-License-Identifier: Apache-2.0
#include "io/report_page.hpp"

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "io/report_assets.hpp"
#include "io/report_text.hpp"

#include <string>

namespace dust::io {

namespace {

std::string script_html(const std::string& name) {
  return "<script>" + std::string(report_asset(name)) + "</script>\n";
}

}  // namespace

std::string page_html(const Page& page) {
  std::string text =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      // The page may ask nobody for anything, whatever stands in the files it was made of.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"dust " DUST_VERSION "\">\n<title>" +
      escape_html(page.title) + " \u2013 " + escape_html(page.kind) + "</title>\n<style>";
  text += report_asset("uPlot.min.css");
  text += report_asset("report.css");
  text += "</style>\n</head>\n<body>\n<main>\n" + page.body + "</main>\n";
  text +=
      "<script type=\"application/json\" id=\"run-data\">" + script_json(page.data) + "</script>\n";
  for (const char* name :
       {"uPlot.iife.min.js", "base.js", "colour.js", "picture.js", "plots.js", "clock.js"}) {
    text += script_html(name);
  }
  for (const std::string& name : page.scripts) text += script_html(name);
  return text + script_html("theme.js") + "</body>\n</html>\n";
}

std::string heading_html(const std::string& kind, const std::string& scenario,
                         const std::string& status, const std::string& title) {
  std::string text = "<p class=\"eyebrow\"><span>" + escape_html(kind) + "</span>";
  if (!scenario.empty()) text += "<span>" + escape_html(scenario) + "</span>";
  if (!status.empty()) {
    text += "<span class=\"status " + std::string(status == "finished" ? "good" : "bad") + "\">" +
            escape_html(status) + "</span>";
  }
  return text + "<button type=\"button\" id=\"theme\" hidden>Dark</button></p>\n<h1>" +
         escape_html(title) + "</h1>\n";
}

std::string footer_html(const std::string& version) {
  return "<footer>Written by dust " + escape_html(version) +
         ". This page is complete in itself and asks no other machine for anything.</footer>\n";
}

void write_page(const std::filesystem::path& target, const std::string& text) {
  write_text(target, text);
}

}  // namespace dust::io
