(a b　c de ​f)﻿;é
