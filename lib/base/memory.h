// Settings of the C library's allocator, and how much memory there is.
#pragma once

#include <cstddef>
#include <memory>

namespace st {

/// Freed memory is kept for the next array instead of being returned: where arrays of megabytes follow each other,
/// fresh pages for each cost as much as the work on them. The heap has large pages where the system gives them on
/// request: fewer faults, and fewer places of pages to look up. Call it once, before the heap grows. No effect on other
/// C libraries than glibc.
void prepare_heap();

/// What is freed and still kept goes back to the system: between two steps, of which the later one needs large arrays
/// that do not fit into what the pieces of the earlier one left.
void return_freed_memory();

/// From now on this process will end with what it does: large structures that would be taken apart then, piece by
/// piece, may be kept. Not for a program that makes them again and again.
void end_with_memory();
bool ends_with_memory();
/// Keeps something to the end of the process, and does not take it apart then. For any thread.
void keep_to_end(std::shared_ptr<const void> thing);

/// Asks the system for large pages where an array of megabytes will be filled and read here and there: fewer faults,
/// and fewer places of pages to look up. Only asks; what is in the array stays.
void prefer_large_pages(void* array, std::size_t bytes);

/// Memory that this process may use, bytes: the machine's, or less where a control group (container, batch job) or a
/// resource limit says so.
double memory_limit();

}  // namespace st
