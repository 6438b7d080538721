// Looking at what calls throw.
#pragma once

#include <string>

namespace gll::test {

// What the call throws as an Error, as text; "" where it throws nothing. Other exceptions pass.
template <class Error, class Call>
std::string messageOf(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

} // namespace gll::test

// For messages: says the whole text where the part is missing.
#define EXPECT_CONTAINS(text, part) EXPECT_PRED_FORMAT2(testing::IsSubstring, part, text)
