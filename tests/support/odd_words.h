// Words that first readers of skybake's texts stumbled over: private vocabulary, sentences without
// a verb, and "a" where a rate is meant. No text that a user reads has them again.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace skybake::test {

inline constexpr std::array<std::string_view, 21> kOddWords = {
    "ready-made",          "will not do",   "text in quotes", "list of texts",   "no words but",
    "more words",          "which vdb has", "an octave less", "made anew",       "claims it",
    "there are: ",         "left as it is", "spends its",     "behind the comm", "has fewer than",
    "no table holds",      "texels a ",     "steps a ray",    "pixels a ",       "names a bake of",
    "copy a source which",
};

// The first of them in a text, whose lines may break anywhere; empty where there is none.
inline std::string_view odd_word_of(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(
        std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }),
        text.end());
    const auto found = std::find_if(
        kOddWords.begin(), kOddWords.end(),
        [&text](std::string_view word) { return text.find(word) != std::string::npos; });
    return found == kOddWords.end() ? std::string_view() : *found;
}

}  // namespace skybake::test
