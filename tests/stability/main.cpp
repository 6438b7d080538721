// stability: provokes the failures, prints their numbers, and holds them to bounds and to the pages' tables.
#include "page_table.hpp"

#include <cstdio>
#include <gtest/gtest.h>

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc != 4) {
        std::fprintf(stderr,
                     "stability: error: name the folders of the programs, the tutorials and the output\n");
        return 2;
    }
    gll::stability::folders = {argv[1], argv[2], argv[3]};
    std::filesystem::create_directories(gll::stability::folders.output);
    return RUN_ALL_TESTS();
}
