// The two streams: results on stdout, words for people and diagnostics on stderr.
#pragma once

#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/diagnostic_printer.h"
#include "cli/exit_code.h"
#include "config/diagnostic.h"

namespace skybake::cli {

// Where text goes. `write` returns false once the other end is gone or the disk is full.
struct Sink {
    std::function<bool(std::string_view)> write;
    bool terminal = false;
};

// A sink that writes to a file descriptor (1 or 2), whole texts, whatever signals arrive.
Sink descriptor_sink(int descriptor);

struct Display {
    DiagnosticFormat diagnostics = DiagnosticFormat::human;
    bool color = false;    // on stderr
    bool quiet = false;    // -q: no notes
    bool verbose = false;  // -v: details too
};

// Whether to colour a stream: --color=always|never decide, auto asks for a terminal without
// NO_COLOR.
bool wants_color(std::string_view choice, bool terminal, const char* no_color);

// Never throws for a stream that is gone. Once a result could not be written the process's exit
// code becomes `io`, see finish. Notes may come from any thread.
class Console {
  public:
    Console(Sink out, Sink error, Display display);

    // To stdout, as it is: the text brings its own newlines.
    void result(std::string_view text);
    // To stderr, unless -q was given or diagnostics are for a machine (json, sarif), which then has
    // stderr to itself.
    void note(std::string_view text);
    // To stderr, only with -v.
    void detail(std::string_view text);

    // Prints diagnostics as --diagnostics wants them, to stderr, and returns the exit code of the
    // gravest (done where there are only warnings or none).
    ExitCode report(std::span<const config::Diagnostic> diagnostics);
    // The same for a command whose results they are (check): json and sarif go to stdout.
    ExitCode report_results(std::span<const config::Diagnostic> diagnostics);

    // Writes what waits for the end of the run (a SARIF document is one whole) and returns the exit
    // code to leave with.
    ExitCode finish(ExitCode code);

    const Display& display() const { return display_; }
    bool error_is_terminal() const { return error_.terminal; }
    bool shows_notes() const;

  private:
    ExitCode report_to(bool results, std::span<const config::Diagnostic> diagnostics);
    void write_error(std::string_view text);

    std::mutex error_mutex_;
    Sink out_;
    Sink error_;
    Display display_;
    bool result_lost_ = false;
    bool sarif_is_result_ = false;
    std::vector<config::Diagnostic> sarif_;
};

}  // namespace skybake::cli
