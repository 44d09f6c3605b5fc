const char* kComplaint = "x is no number";
