// Belongs to a top folder that no guard knows.
