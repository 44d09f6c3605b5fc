/// Returns the height of the seam.
