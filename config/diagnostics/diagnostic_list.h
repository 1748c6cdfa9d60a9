// Collects the diagnostics of one recipe while it is read, and hands them over: warnings first, so
// that errors are the last on a terminal, and each in reading order.
#pragma once

#include <string>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

class DiagnosticList {
  public:
    void error(std::string code, const Place& place, std::string message, std::string label = "");
    void warning(std::string code, const Place& place, std::string message, std::string label = "");

    bool has_errors() const { return errors_ > 0; }

    // Warnings, then errors, each sorted by source, line and column. More than a person can read is
    // cut off, and a last diagnostic says how many more there were.
    std::vector<Diagnostic> take();

  private:
    struct Item {
        Severity severity;
        std::string code;
        std::string message;
        Place place;
        std::string label;
    };
    void add(Item item);

    std::vector<Item> items_;
    int errors_ = 0;
    int left_out_ = 0;
};

// The place with the text of its line, without its line ending. Lines too long to show come
// without.
SourceRange source_range(const Place& place);

}  // namespace skybake::config
