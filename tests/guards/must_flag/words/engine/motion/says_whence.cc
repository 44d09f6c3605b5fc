// Goes back whence it came.
