// Files of numbers, as tests/data has them.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace skybake::test {

// Returns the rows of a CSV file, without its comments (#), its head and its first columns of texts.
inline std::vector<std::vector<double>> number_rows(const std::string& path, int texts = 0) {
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells(line);
        std::string cell;
        for (int i = 0; i < texts; ++i) std::getline(cells, cell, ',');
        if (line.empty() || line[0] == '#' || std::isalpha(cells.peek())) continue;
        rows.emplace_back();
        while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
    }
    return rows;
}

}  // namespace skybake::test
