// Settings of the C library's allocator.
#pragma once

namespace st {

/// Freed memory is kept for the next array instead of being returned: where arrays of megabytes follow each other, fresh pages for each cost as
/// much as the work on them. Call it once, early. No effect on other C libraries than glibc.
void keep_freed_memory();

}  // namespace st
