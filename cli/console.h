// What the process tells the world, and is told by signals: results on stdout, words for people and
// diagnostics on stderr, the exit code.
#pragma once

#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/diagnostic_printer.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// What the process says to the shell. main.cpp is the only place that exits.
enum class ExitCode : int {
    done = 0,
    differs = 1,   // a comparison or verification differs
    usage = 2,     // usage or parameter error
    io = 3,        // cannot open, read or write
    checks = 4,    // the result failed its physical or error checks
    internal = 5,  // a mistake of the program's own
    interrupted = 130,
};

// Where text goes. `write` returns false once the other end is gone or the disk is full.
struct Sink {
    std::function<bool(std::string_view)> write;
    bool terminal = false;
    int columns = 0;  // of the terminal; 0 where they are not known
};

// A sink that writes to a file descriptor (1 or 2), whole texts, whatever signals arrive.
Sink descriptor_sink(int descriptor);

struct Display {
    DiagnosticFormat diagnostics = DiagnosticFormat::human;
    bool color = false;        // on stderr
    bool quiet = false;        // -q: no notes
    bool verbose = false;      // -v: details too
    bool json = false;         // --json: results are events on stdout, and so is a failure
    std::string command = {};  // for that event; empty where none was understood
};

// What the environment says about colours; null where a variable is not set.
struct ColorEnvironment {
    const char* no_color = nullptr;        // https://no-color.org
    const char* clicolor_force = nullptr;  // https://bixense.com/clicolors
    const char* force_color = nullptr;     // https://force-color.org
};

enum class WhenColor { automatic, always, never };

// Whether to colour a stream. --color=always and --color=never decide. With auto, NO_COLOR turns
// colours off, else CLICOLOR_FORCE or FORCE_COLOR turns them on, else a terminal gets them. A
// variable that is empty counts as not set; `0` forces nothing.
bool wants_color(WhenColor choice, bool terminal, const ColorEnvironment& environment);

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

    // Writes what waits for the end of the run, a SARIF document and the event of a failure, and
    // returns the exit code to leave with.
    ExitCode finish(ExitCode code);

    const Display& display() const { return display_; }
    bool error_is_terminal() const { return error_.terminal; }
    bool shows_notes() const;
    // Of the terminal that notes go to; 0 where there is none, or it does not say.
    int error_columns() const { return error_.columns; }

  private:
    ExitCode report_to(bool results, std::span<const config::Diagnostic> diagnostics);
    void write_error(std::string_view text);
    ExitCode exit_code(ExitCode code) const;

    std::mutex error_mutex_;
    Sink out_;
    Sink error_;
    Display display_;
    bool result_lost_ = false;
    bool sarif_is_result_ = false;
    std::vector<config::Diagnostic> sarif_;
    std::vector<config::Diagnostic> reported_;  // with --json
};

// --- Ctrl-C and its kin -------------------------------------------------------------------------

// The first signal asks the bake to stop and leave no partial file, a second one ends the process
// at once (and leaves none either).

// Takes over SIGINT, SIGTERM and SIGHUP; ignores SIGPIPE and SIGXFSZ, whose errors the writes
// report.
void install_signal_handlers();

// True once a signal has arrived.
bool interrupted();

}  // namespace skybake::cli
