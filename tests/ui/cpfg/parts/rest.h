	C(1, 2) /* A line of a production of the file that includes this one. What is longer than all of it? */ [ D
