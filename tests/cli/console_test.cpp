#include "cli/console.h"

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

struct Capture {
    std::string out, error;
    Console console(Display display = {}, bool broken = false) {
        return Console({[this, broken](std::string_view text) {
                           if (!broken) out += text;
                           return !broken;
                       }},
                       {[this](std::string_view text) {
                           error += text;
                           return true;
                       }},
                       display);
    }
};

std::vector<config::Diagnostic> one(const std::string& code) {
    config::Diagnostic diagnostic;
    diagnostic.code = code;
    diagnostic.message = "something";
    if (code[0] == 'W') diagnostic.severity = config::Severity::warning;
    return {diagnostic};
}

TEST(Console, SendsResultsAndNotesApart) {
    Capture capture;
    Console console = capture.console();
    console.result("out.exr\n");
    console.note("a table\n");
    console.detail("a detail\n");
    EXPECT_EQ(capture.out, "out.exr\n");
    EXPECT_EQ(capture.error, "a table\n");
    EXPECT_EQ(console.finish(ExitCode::done), ExitCode::done);
}

// Names of files and of assets may hold anything. Whatever prints them, a terminal is not controlled.
TEST(Console, NothingControlsTheTerminal) {
    Capture capture;
    Console console = capture.console();
    const std::string name = "a\x1b[2Jb\x07\x7f\xc2\x9b\x9b.exr";
    const std::string shown = "a\\u001b[2Jb";
    console.result(name + "\n\tand more\n");
    console.note(name + "\n");
    console.rewrite_line(name);
    config::Diagnostic diagnostic = one("E0300").front();
    diagnostic.message = name;
    diagnostic.label = name;
    diagnostic.where.source = name;
    console.report(std::span(&diagnostic, 1));
    for (const std::string* text : {&capture.out, &capture.error}) {
        EXPECT_EQ(text->find(shown), text->find("a\\")) << *text;
        for (const char* control : {"\x1b[2", "\x07", "\x7f", "\xc2\x9b", "\x9b"}) {
            EXPECT_EQ(text->find(control), std::string::npos) << *text;
        }
    }
    EXPECT_TRUE(capture.out.ends_with("\n\tand more\n"));
}

TEST(Console, QuietSilencesNotesButNotErrors) {
    Capture capture;
    Console console = capture.console({.quiet = true});
    console.note("a table\n");
    console.report(one("E0102"));
    EXPECT_EQ(capture.error, "error[E0102]: something\n");
}

TEST(Console, KnowsExitCodes) {
    Capture capture;
    Console console = capture.console();
    EXPECT_EQ(console.report({}), ExitCode::done);
    EXPECT_EQ(console.report(one("W0201")), ExitCode::done);
    EXPECT_EQ(console.report(one("E0102")), ExitCode::usage);
    EXPECT_EQ(console.report(one("E0301")), ExitCode::io);
    EXPECT_EQ(console.report(one("E0401")), ExitCode::checks);
    EXPECT_EQ(console.report(one("E0500")), ExitCode::internal);
}

TEST(Console, ALostResultIsAnError) {
    Capture capture;
    Console console = capture.console({}, true);
    console.result("out.exr\n");
    EXPECT_EQ(console.finish(ExitCode::done), ExitCode::io);
    EXPECT_EQ(console.finish(ExitCode::checks), ExitCode::checks);
}

TEST(Console, MachinesHaveStderrToThemselves) {
    Capture capture;
    Console console = capture.console({.diagnostics = DiagnosticFormat::sarif});
    console.note("a table\n");
    console.report(one("E0102"));
    console.report(one("W0201"));
    EXPECT_EQ(capture.error, "");
    console.finish(ExitCode::usage);
    const auto document = nlohmann::json::parse(capture.error);
    EXPECT_EQ(document["runs"][0]["results"].size(), 2u);
    EXPECT_EQ(capture.out, "");
}

TEST(Console, DiagnosticsMayBeTheResult) {
    for (const auto format : {DiagnosticFormat::json, DiagnosticFormat::sarif}) {
        Capture capture;
        Console console = capture.console({.diagnostics = format});
        console.report_results(one("E0102"));
        console.finish(ExitCode::usage);
        EXPECT_NE(capture.out, "");
        EXPECT_EQ(capture.error, "");
    }
    Capture capture;
    capture.console().report_results(one("E0102"));
    EXPECT_EQ(capture.out, "");
    EXPECT_NE(capture.error, "");
}

TEST(Console, ColourDependsOnWishTerminalAndEnvironment) {
    EXPECT_TRUE(wants_color(WhenColor::always, false, {.no_color = "1"}));
    EXPECT_FALSE(wants_color(WhenColor::never, true, {}));
    EXPECT_FALSE(wants_color(WhenColor::never, true, {.clicolor_force = "1", .force_color = "1"}));
    EXPECT_TRUE(wants_color(WhenColor::automatic, true, {}));
    EXPECT_TRUE(wants_color(WhenColor::automatic, true, {.no_color = ""}));
    EXPECT_FALSE(wants_color(WhenColor::automatic, true, {.no_color = "1"}));
    EXPECT_FALSE(wants_color(WhenColor::automatic, false, {}));
    EXPECT_TRUE(wants_color(WhenColor::automatic, false, {.clicolor_force = "1"}));
    EXPECT_TRUE(wants_color(WhenColor::automatic, false, {.force_color = "3"}));
    for (const char* nothing : {"", "0"}) {
        EXPECT_FALSE(wants_color(WhenColor::automatic, false, {.clicolor_force = nothing}));
        EXPECT_FALSE(wants_color(WhenColor::automatic, false, {.force_color = nothing}));
    }
    EXPECT_FALSE(wants_color(WhenColor::automatic, false, {.no_color = "1", .force_color = "1"}));
}

TEST(Console, AFailureIsAnEvent) {
    Capture capture;
    Console console = capture.console({.json = true, .command = "bake"});
    console.report(one("W0201"));
    console.report(one("E0301"));
    EXPECT_EQ(capture.out, "");
    EXPECT_EQ(console.finish(ExitCode::io), ExitCode::io);
    const auto event = nlohmann::json::parse(capture.out);
    EXPECT_EQ(event["event"], "failed");
    EXPECT_EQ(event["command"], "bake");
    EXPECT_EQ(event["exit_code"], 3);
    ASSERT_EQ(event["diagnostics"].size(), 2u);
    EXPECT_EQ(event["diagnostics"][1]["code"], "E0301");
    EXPECT_NE(capture.error, "");  // people read it, too
}

TEST(Console, WhatDiffersHasNotFailed) {
    for (const ExitCode code : {ExitCode::done, ExitCode::differs}) {
        Capture capture;
        EXPECT_EQ(capture.console({.json = true}).finish(code), code);
        EXPECT_EQ(capture.out, "");
    }
    Capture capture;
    capture.console({.json = false}).finish(ExitCode::usage);
    EXPECT_EQ(capture.out, "");
}

}  // namespace
}  // namespace skybake::cli
