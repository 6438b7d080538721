// A folder that is there as long as its object lives, and what lies in files.
#pragma once

#include "process/temporary_folder.hpp"

namespace gll::test {

using gll::contents;
using gll::TemporaryFolder;

} // namespace gll::test
