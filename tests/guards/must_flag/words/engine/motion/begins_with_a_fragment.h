#pragma once
/// Whether the clip is long.
bool IsLong();
