// Programs that read their own artifacts again and again.
#pragma once

namespace st {

/// From now on an artifact that was read is not listed again while path, inode, size and time of the file stay. For a
/// program whose artifacts nobody else writes: a file changed in place within a tick of the clock would not be seen.
void keep_listings();

}  // namespace st
