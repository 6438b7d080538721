// Ctrl-C in the middle of a long run: ends at once, with whole files only.
#include "hostile/hostile.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace gll::test {
namespace {

bool isWholePng(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    return bytes.starts_with("\x89PNG") && bytes.size() > 12 &&
           bytes.compare(bytes.size() - 8, 4, "IEND") == 0; // its checksum is last
}

TEST(Interrupt, endsASequenceAtOnceAndLeavesOnlyWholeFiles) {
    const TemporaryFolder folder;
    Process process(rungCommand(folder, {"--frames", "1..100000", "--size", "64x48", "--out", "f%06d.png"}));
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (folder.listing().size() < 3 && std::chrono::steady_clock::now() < give_up)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const auto asked = std::chrono::steady_clock::now();
    process.signal(SIGINT);
    const Result result = process.wait(std::chrono::seconds(30));
    EXPECT_FALSE(result.timed_out);
    EXPECT_FALSE(result.signalled);
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.err, "");
    // A frame takes milliseconds; the rest is for a machine that is busy, or for a sanitizer's exit.
    EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(5));
    const std::vector<std::string> files = folder.listing();
    EXPECT_GE(files.size(), 3U);
    EXPECT_LT(files.size(), 100'000U);
    for (const std::string& file : files)
        EXPECT_TRUE(file.ends_with(".png") && isWholePng(folder / file)) << file;
    // What was said to be written is what there is.
    EXPECT_EQ(static_cast<std::size_t>(std::count(result.out.begin(), result.out.end(), '\n')), files.size());
}

} // namespace
} // namespace gll::test
