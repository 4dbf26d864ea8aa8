#include "tools/monitor/page_files.hpp"

// The assembler takes the files as they are. PLUMB_PAGE_DIR is where the build put them.
#define PLUMB_EMBED(symbol, file)                                                         \
  __asm__(                                                                                \
      ".section .rodata\n"                                                                \
      ".global " #symbol "_begin\n.global " #symbol "_end\n" #symbol                      \
      "_begin:\n.incbin \"" PLUMB_PAGE_DIR "/" file "\"\n" #symbol "_end:\n.previous\n"); \
  extern "C" const char symbol##_begin[];                                                 \
  extern "C" const char symbol##_end[]

PLUMB_EMBED(plumb_page_html, "index.html");
PLUMB_EMBED(plumb_page_script, "page.js");
PLUMB_EMBED(plumb_page_style, "page.css");

namespace plumb {

std::vector<WebFile> page_files() {
  const WebFile html{"/", "text/html; charset=utf-8", {plumb_page_html_begin, plumb_page_html_end}};
  if (html.bytes.empty()) return {};
  return {html,
          {"/page.js",
           "text/javascript; charset=utf-8",
           {plumb_page_script_begin, plumb_page_script_end}},
          {"/page.css", "text/css; charset=utf-8", {plumb_page_style_begin, plumb_page_style_end}}};
}

}  // namespace plumb
