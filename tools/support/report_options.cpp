#include "tools/support/report_options.hpp"

#include <iostream>

#include "platform/command_line.hpp"

namespace plumb {

void add_json_option(CommandLine* app, std::string* json) {
  app->add_option("--json", *json, "write the figures to FILE").type_name("FILE");
}

void add_report_options(CommandLine* app, ReportOptions* options) {
  add_json_option(app, &options->json);
  app->add_option("--plots", options->plots, "draw pictures into DIR").type_name("DIR");
  app->add_option("--plot-format", options->plot_format, "format of the pictures")
      .check(one_of({"png", "svg"}))
      .capture_default_str();
}

void print_written(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) std::cout << "wrote " << file.string() << "\n";
}

}  // namespace plumb
