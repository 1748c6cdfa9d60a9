// Records what verification finds in one file, and checks the file's probes.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <utility>

#include "bakers/field/wrong_lookups.h"
#include "bakers/io/manifest/verify.h"
#include "config/text/key_path.h"

namespace skybake {

// Counts checks and keeps the failed ones of one file.
class Examination {
  public:
    Examination(VerifyReport& report, std::string file) : report_(report), file_(std::move(file)) {}

    void fail(std::string check, const std::string& message) {
        // The contents of a damaged file may not be printable text.
        report_.failures.push_back({file_, std::move(check), config::printable(message)});
    }
    bool expect(bool holds, const char* check, const std::string& message) {
        ++report_.checks;
        if (!holds) fail(check, message);
        return holds;
    }
    template <class T>
    bool expect_equal(const T& found, const T& wanted, const char* check, std::string_view what) {
        return expect(found == wanted, check,
                      fmt::format("{} is {}, the manifest says {}", what, found, wanted));
    }
    // Expects that a file could be read. If not, `check` names what failed.
    template <class T>
    bool expect_read(const Outcome<T>& outcome, const char* check) {
        return expect(outcome.value.has_value(), check,
                      outcome.value ? "" : outcome.diagnostics[0].message);
    }
    void count(int checks) { report_.checks += checks; }

  private:
    VerifyReport& report_;
    std::string file_;
};

// A probe: its lookups, and the value that they must give within the tolerance.
struct CaughtProbe {
    std::vector<ProbeLookup> lookups;
    std::vector<double> value;
    std::vector<double> tolerance;
};

// Makes each wrong lookup that the probes are said to catch (wrong_lookups.h) and checks that it
// shows at several probes. Probes with another number of channels are left to check_lookup.
void check_catches(Examination& examination, const ReadableTexture& texture, int dimensions,
                   const std::vector<CaughtProbe>& probes, const std::vector<std::string>& catches);

// Checks that a lookup gives the probe's value within its tolerance.
void check_lookup(Examination& examination, const std::string& place,
                  const std::vector<double>& found, const std::vector<double>& value,
                  const std::vector<double>& tolerance);

}  // namespace skybake
